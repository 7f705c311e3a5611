// How much a decision changes when each input moves by an ulp (docs/verdicts.md). Private to oracle/.
//
// The inputs are the components of x, each with an ulp of max(ulp(x_i), ulp(size)); those of v, each with
// ulp(v_i), where a zero does not move; and the radius of each atom with its ulp, an ellipsoid with a factor
// 1 +- 2^(1-p), where the engine's numbers have p bits. `size` is that of the primitive vectors, and of the
// atoms of lattices that repeat in fewer directions.
//
// Everything is in the coordinates of one atom's View, in which its obstacles are balls. A change dx of x is
// B dx there, with B = to_ball. With T = s / v^2 the time at which the line is nearest to the centre c, and t
// the time of entry:
//
//   distance |x - c|          d = m.B dx,                    m the unit vector from c to x
//   distance of the line      d = n.B (dx + T dv),           n the unit vector from c to the nearest point
//   time of entry             d = (a.(dx + t dv) - r dr / sqrt(D)),
//                             a = B^T (t v - c) / sqrt(D),   D = rho^2 - |h|^2
//   time of exit              the same with -sqrt(D) in place of sqrt(D)
//
// The largest change is the sum of the absolute values, each times the ulp of its input.
#pragma once

#include <lorentz/claim.hpp>
#include "oracle/exact/exact_query.hpp"
#include "oracle/exact/real.hpp"
#include "oracle/exact/stretches.hpp"

namespace lorentz::oracle {

constexpr double kHuge = 1e300;  ///< reported for all larger values

/// A centre seen from x, in the coordinates of its atom's view.
template <std::size_t D>
struct Centre {
  LatticePoint<D> point;
  Z s, c2, h2;  ///< v.c, |c|^2, |h|^2 = v^2 c^2 - s^2

  Centre(const ExactVelocity<D>& velocity, LatticePoint<D> centre)
      : point(std::move(centre)),
        s(dot(velocity.v, point.p)),
        c2(dot(point.p, point.p)),
        h2(velocity.v2 * c2 - s * s) {}
};

/// Passes to `look` the centre at `point`, and `more` that follow it at `step`.
template <std::size_t D, class Look>
void visit_row_of_centres(const ExactVelocity<D>& velocity, LatticePoint<D> point,
                          const LatticePoint<D>& step, long more, const Look& look) {
  Centre<D> centre(velocity, std::move(point));
  if (more == 0) return look(centre);
  // c^2 and h^2 are quadratic functions: their differences from one to the next are linear.
  const Z sg = dot(velocity.v, step.p), gg2 = 2 * dot(step.p, step.p), hh2 = velocity.v2 * gg2 - 2 * sg * sg;
  Z c2_on = 2 * dot(centre.point.p, step.p) + (gg2 >> 1),
    h2_on = velocity.v2 * c2_on - sg * (2 * centre.s + sg);
  for (look(centre); more > 0; --more, look(centre)) {
    centre.point.add_multiple(1, step);
    centre.s += sg, centre.c2 += c2_on, centre.h2 += h2_on;
    c2_on += gg2, h2_on += hh2;
  }
}

/// The most rows of one stretch that are looked at: there may be millions without a centre.
inline constexpr int kMostRows = 1'000'000;

/// Passes to `look` the centres with |h|^2 < reach2 and low <= s <= high; in long rows, those that
/// visit_extremes chooses. Ends when `spend(steps)` returns true, which is called before each stretch (1
/// step), after each row (0 steps), and where rows are left out (kMostRows). Returns whether it ended early.
template <std::size_t D, class Look, class Spend>
bool visit_centres(const View<D>& view, const Z& reach2, const Z& low, const Z& high, const Look& look,
                   const Spend& spend) {
  const Stretches<D> stretches(view, reach2);
  const RowVisitor<D> visit = [&](const LatticePoint<D>& first, const LatticePoint<D>& step, const Z& last) {
    visit_extremes<D>(view.velocity, first, step, last, [&](LatticePoint<D> point, long more) {
      visit_row_of_centres(view.velocity, std::move(point), step, more, look);
    });
    return spend(0);
  };
  return stretches.cut(low, high, [&](const RowStretch<D>& stretch) {
    return spend(1) || stretches.visit(stretch, visit, kMostRows) ||
           (stretch.rows > kMostRows && spend(kMostRows));
  });
}

/// The size of an ulp of each input, in the units of an exact query.
template <std::size_t D>
struct InputUlps {
  std::array<Real, D> x, v;

  NumberFormat precision;

  InputUlps(const Scene& scene, const Query& query, const ExactQuery<D>& exact, NumberFormat of_numbers);
};

/// The end of a chord: where the line enters the obstacle, or where it leaves it.
enum class ChordEnd { entry = -1, exit = +1 };

/// The time of an end with its derivatives: dt = sum of by_x (dx + t dv) - by_radius dr.
template <std::size_t D>
struct PerturbedArrival {
  Real t;
  std::array<Real, D> by_x;
  Real by_radius;
};

/// One atom's obstacles, and the uncertainty of all their quantities.
template <std::size_t D>
class Uncertain {
 public:
  Uncertain(const Scene& scene, const ExactScene<D>& exact_scene, const ExactQuery<D>& exact,
            const InputUlps<D>& ulps, int lattice, int atom);

  const View<D>& view() const { return view_; }
  const Z& rho2() const { return rho2_; }
  int lattice() const { return lattice_; }
  int atom() const { return atom_; }
  const Real& speed() const { return speed_; }

  /// ||x - c| - r| in ulps.
  Real margin_of_containing(const Centre<D>& centre) const;
  /// |distance of the line - r| in ulps.
  Real margin_of_meeting(const Centre<D>& centre) const;
  /// Lower bounds of the two, but for 2^-40 of them: the ulps of x and v count as if each moved the line straight
  /// towards c. They cost far less than the margins. NaN if a number is beyond the range of an Estimate.
  Estimate least_of_containing(const Centre<D>& centre) const;
  Estimate least_of_meeting(const Centre<D>& centre) const;
  /// The same for margin_of_order, of centres with s > 0.
  Estimate least_of_order(const Centre<D>& centre, const Uncertain& other, const Centre<D>& its) const;
  /// |s| in ulps, for whether the centre is ahead.
  Real margin_of_ahead(const Centre<D>& centre) const;
  /// For an obstacle that is met. time_of accepts missed obstacles: they count as entered where the line is
  /// nearest to them. (Their derivatives would be infinite, so `arrival` throws for them.)
  PerturbedArrival<D> arrival(const Centre<D>& centre, ChordEnd end = ChordEnd::entry) const;
  Real time_of(const Centre<D>& centre, ChordEnd end = ChordEnd::entry) const;
  /// The largest change of this time.
  Real change_of_time(const Centre<D>& centre, ChordEnd end = ChordEnd::entry) const;
  /// The difference of the times of entry of this atom's obstacle and another one, in ulps; zero for a tie.
  Real margin_of_order(const Centre<D>& centre, const Uncertain& other, const Centre<D>& its) const;

  /// True if the line enters the obstacle at t >= 0.
  bool is_entered(const Centre<D>& centre) const {
    return centre.s > 0 && centre.h2 < rho2_ && centre.c2 >= view_.radius2;
  }

  /// The largest change of the position of x along a direction, plus that of r.
  Real change_along(const ZVec<D>& direction) const;

  /// A bound of the change of |distance of the line - r| and of ||x - c| - r| for all centres with
  /// |T| <= latest.
  Real largest_change(const Real& latest) const;
  /// The same for the distance of the line alone.
  Real largest_change_across(const Real& latest) const;

 private:
  /// Sum of |(B^T a)_i| ulp_i.
  Real weighted(const ZVec<D>& a, const std::array<Real, D>& ulp) const;
  /// The largest length of B y over the corners |y_i| = ulp_i, or of its part across the flight.
  Real longest_corner(const std::array<Real, D>& ulp, bool across) const;
  std::array<Real, D> ulps_at(const Real& time) const;
  /// About the time of entry, for s > 0, and an upper bound of its change.
  std::pair<Estimate, Estimate> about_arrival(const Centre<D>& centre) const;

  const InputUlps<D>& ulps_;
  int lattice_, atom_;
  bool is_ball_;
  ZMatrix<D> to_ball_transposed_;
  std::array<Real, D> stretch_;  // the lengths of its rows
  View<D> view_;
  Z rho2_;
  Real radius_ulp_, speed_, rho_;
  // about_change_ and about_growth_: largest_change at 0, and its growth in time
  Estimate about_speed_, about_v2_, about_radius_, about_change_, about_growth_;
};

}  // namespace lorentz::oracle
