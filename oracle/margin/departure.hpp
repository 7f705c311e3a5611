// The number of ulps by which the inputs must move for another answer to be right. Private to oracle/.
#pragma once

#include <cmath>
#include <limits>

#include "oracle/exact/stretches.hpp"
#include "oracle/margin/perturbed_query.hpp"

namespace lorentz::oracle {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The most obstacles and stretches of the line that are looked at before one obstacle is met by more than the
// tolerance. A line that grazes a row can meet any number of obstacles by less than that. The farther an
// obstacle is, the more the inputs' last bits move the line there, so obstacles beyond these would be passed
// over by even less.
inline constexpr std::size_t kMostPassedOver = 100'000;

// How far a flight along a lattice is followed, in radii, as a power of two: farther than binary64 reaches.
inline constexpr long kFarthestBeside = 1080;

struct Departure {
  double ulps = 0;
  std::optional<ObstacleId> obstacle = {};  // the obstacle that needs this number
};

// The number of ulps by which the inputs must move for an answer to be right, and the obstacle that requires
// it. Computed until it certainly exceeds the tolerance.
template <std::size_t D>
class DepartureBound {
 public:
  /// `pass_around`: obstacles that contain x do not count.
  DepartureBound(const PerturbedQuery<D>& perturbed, const Answer& exact, double ulps,
                 std::optional<double> time_tolerance, bool pass_around = false)
      : query_(perturbed),
        exact_(exact),
        ulps_(ulps),
        time_tolerance_(time_tolerance),
        pass_around_(pass_around) {
    if (time_tolerance_ && std::isinf(*time_tolerance_)) time_tolerance_.reset();  // times are not judged
  }

  bool used_tolerance() const { return used_tolerance_; }  ///< of times, for an obstacle that was passed over
  std::size_t passed_over() const { return passed_over_; }  ///< steps: of the last atom, for some answers

  Departure of(const Answer& given) {
    switch (given.outcome) {
      case Outcome::hit:
        bound_hit(given.obstacle);
        break;
      case Outcome::inside:
        bound_inside(given.obstacle);
        break;
      default:
        bound_never();
    }
    return needed_;
  }

 private:
  bool exceeds_tolerance() const { return needed_.ulps > ulps_; }
  // Counts the obstacles and stretches that are passed over. Returns whether to stop.
  bool pass_over(int steps) {
    passed_over_ += steps;
    return exceeds_tolerance() || passed_over_ > kMostPassedOver;
  }
  void needs(double margin, const ObstacleId& obstacle) {
    if (margin > needed_.ulps) needed_ = {margin, obstacle};
  }
  void needs(const Real& margin, const Uncertain<D>& atom, const Centre<D>& centre) {
    const double ulps = to_double(margin, kHuge);
    if (ulps > needed_.ulps) needed_ = {ulps, query_.id_of(atom, centre.point.n)};
  }

  // X is entered, or missed by at most k. No obstacle contains x, or is entered earlier, with more than k to
  // spare.
  void bound_hit(const ObstacleId& id) {
    const Uncertain<D>& atom = query_.atom_of(id);
    const Centre<D> centre = query_.centre_of(id);
    bound_containing([&](const Uncertain<D>& other, const Centre<D>& its) {
      const bool is_target = &other == &atom && its.point.n == centre.point.n;
      if (!is_target && !is_after(atom, centre, other, its))
        bound_entered_at_once(other, its, [&] { return spare_before(atom, centre, other, its); });
      return true;
    });
    if (exceeds_tolerance()) return;
    if (query_.is_from(atom, centre.point.n)) needs(kInfinity, id);
    if (centre.h2 >= atom.rho2()) needs(atom.margin_of_meeting(centre), atom, centre);
    if (centre.c2 < atom.view().radius2) needs(atom.margin_of_containing(centre), atom, centre);
    if (centre.s <= 0) needs(atom.margin_of_ahead(centre), atom, centre);
    if (!exceeds_tolerance() && exact_.outcome == Outcome::hit)
      bound_earlier(atom, centre, query_.atom_of(exact_.obstacle), query_.centre_of(exact_.obstacle));
    for (const Uncertain<D>& other : query_.atoms())
      if (!exceeds_tolerance()) bound_all_earlier(atom, centre, other);
  }

  // X contains x, or nearly. No smaller obstacle does so with more than k to spare.
  void bound_inside(const ObstacleId& id) {
    const Uncertain<D>& atom = query_.atom_of(id);
    const Centre<D> centre = query_.centre_of(id);
    if (query_.is_from(atom, centre.point.n)) needs(kInfinity, id);
    if (centre.c2 >= atom.view().radius2) needs(atom.margin_of_containing(centre), atom, centre);
    if (exceeds_tolerance()) return;
    const auto key = std::tuple(id.lattice, id.atom, centre.point.n);
    bound_containing([&](const Uncertain<D>& other, const Centre<D>& its) {
      return std::tuple(other.lattice(), other.atom(), its.point.n) < key;
    });
  }

  // No obstacle contains x with more than k to spare, and there is an open corridor that contains x and whose
  // direction is within k ulps of v.
  void bound_never() {
    bound_containing([&](const Uncertain<D>& atom, const Centre<D>& centre) {
      bound_entered_at_once(atom, centre, [] { return Real(kHuge); });
      return true;
    });
    if (exceeds_tolerance() || exact_.outcome == Outcome::never) return;
    if (is_open_everywhere(query_.scene())) return bound_all_entered();
    needs(open_near(query_, ulps_) ? ulps_to_open_way() : kInfinity, exact_.obstacle);
  }

  // No obstacle is entered with more than k to spare. The obstacle that is hit comes first.
  void bound_all_entered() {
    if (exact_.outcome == Outcome::hit) {
      const Uncertain<D>& hit = query_.atom_of(exact_.obstacle);
      const Centre<D> centre = query_.centre_of(exact_.obstacle);
      needs(hit.margin_of_meeting(centre), hit, centre);
    }
    for (const Uncertain<D>& atom : query_.atoms()) {
      if (exceeds_tolerance()) return;
      passed_over_ =
          0;  // a row of this atom beside the line, without an end, must not use up the next atom's share
      const View<D>& view = atom.view();
      const std::optional<Z> end = last_s(view);
      const auto look = [&](const Centre<D>& centre) {
        ++passed_over_;
        if (atom.is_entered(centre) && !query_.is_from(atom, centre.point.n))
          needs(atom.margin_of_meeting(centre), atom, centre);
      };
      // A flight along the lattice has no end. It is followed up to the first obstacle with more to spare.
      const Z near = root_below(atom.rho2()) + 2, farthest = end ? *end : shifted_left(near, kFarthestBeside);
      Z low = 1, high = near;
      for (bool done = false; !done && passed_over_ <= kMostPassedOver; low = high, high *= 2) {
        done = high >= farthest;
        const Z limit = done ? farthest : high;
        if (low < limit)
          done |=
              visit_centres(view, atom.rho2(), low, limit, look, [&](int steps) { return pass_over(steps); });
      }
    }
  }

  // The tolerance is enough. Finds the part of it that is enough, to 1 part in 1000.
  double ulps_to_open_way() const {
    double too_few = 0, enough = ulps_;
    for (int halvings = 0; halvings < 10; ++halvings) {
      const double between = (too_few + enough) / 2;
      (open_near(query_, between) ? enough : too_few) = between;
    }
    return enough;
  }

  // The obstacles that contain x, if `counts` returns true for them. A ball of very many cells is not searched
  // to its middle from the rim, where it contains x by little; its obstacle nearest to x is looked at then.
  template <class Counts>
  void bound_containing(const Counts& counts) {
    if (exact_.outcome != Outcome::inside) return;
    for (const Uncertain<D>& atom : query_.atoms()) {
      const View<D>& view = atom.view();
      const auto look = [&](const Centre<D>& centre) {
        ++passed_over_;
        if (query_.is_from(atom, centre.point.n) || centre.c2 >= view.radius2 || !counts(atom, centre))
          return;
        needs(atom.margin_of_containing(centre), atom, centre);
      };
      visit_ball<D>(view.basis, view.offset, view.radius2,
                    [&](const LatticePoint<D>& first, const LatticePoint<D>& step, const Z& last) {
                      visit_extremes<D>(view.velocity, first, step, last,
                                        [&](const LatticePoint<D>& point, long more) {
                                          visit_row_of_centres(view.velocity, point, step, more, look);
                                        });
                      return pass_over(1);
                    });
      if (passed_over_ > kMostPassedOver) look(Centre<D>(view.velocity, view.offset));
      if (exceeds_tolerance()) return;
    }
  }

  // An obstacle that contains x. If x is moved outside, the obstacle is entered at once, unless it is missed
  // or lies behind the start; or, with a margin of `later()`, it is entered after another obstacle.
  template <class Later>
  void bound_entered_at_once(const Uncertain<D>& atom, const Centre<D>& centre, const Later& later) {
    if (centre.s <= 0) return;
    const Real spare = std::min(atom.margin_of_meeting(centre), atom.margin_of_ahead(centre));
    if (to_double(spare, kHuge) > needed_.ulps) needs(std::min(spare, later()), atom, centre);
  }

  // Compare the entry of an obstacle that is met with that of X or, if X is missed, with the point of the
  // line nearest to X.
  static bool is_after(const Uncertain<D>& target, const Centre<D>& hit, const Uncertain<D>& atom,
                       const Centre<D>& centre) {
    const Z chord2 = target.rho2() - hit.h2, grazing = chord2 > 0 ? chord2 : Z(0);
    return compare_entries(centre.s, atom.rho2() - centre.h2, atom.view().velocity.v2, hit.s, grazing,
                           target.view().velocity.v2) > 0;
  }
  static Real spare_before(const Uncertain<D>& target, const Centre<D>& hit, const Uncertain<D>& atom,
                           const Centre<D>& centre) {
    if (hit.h2 < target.rho2()) return atom.margin_of_order(centre, target, hit);
    return (target.time_of(hit) - atom.time_of(centre)) / atom.change_of_time(centre);
  }

  // The obstacles of one atom that are entered before X. If X is missed by a little, the point of the line
  // nearest to X counts.
  void bound_all_earlier(const Uncertain<D>& target, const Centre<D>& hit, const Uncertain<D>& atom) {
    const View<D>& view = atom.view();
    const Z end = ceiling(target.time_of(hit) * real(view.velocity.v2)) + root_below(atom.rho2()) + 1;
    visit_centres(
        view, atom.rho2(), 1, end, [&](const Centre<D>& centre) { bound_earlier(target, hit, atom, centre); },
        [&](int steps) { return pass_over(steps); });
  }

  // An obstacle that may be entered before X: how much it has to spare.
  void bound_earlier(const Uncertain<D>& target, const Centre<D>& hit, const Uncertain<D>& atom,
                     const Centre<D>& centre) {
    ++passed_over_;
    const bool is_target = &atom == &target && centre.point.n == hit.point.n;
    if (is_target || query_.is_from(atom, centre.point.n)) return;
    if (!atom.is_entered(centre)) return;
    if (is_after(target, hit, atom, centre)) return;
    if (is_excused_by_time(target.time_of(hit), atom, centre)) {
      used_tolerance_ = true;
      return;
    }
    Real spare = atom.margin_of_meeting(centre);
    if (pass_around_) spare = std::min(spare, atom.margin_of_containing(centre));
    if (to_double(spare, kHuge) > needed_.ulps)
      needs(std::min(spare, spare_before(target, hit, atom, centre)), atom, centre);
  }

  // True if the obstacle is entered before `time` by at most the tolerance times its own entry time, and not
  // yet left at `time`.
  bool is_excused_by_time(const Real& time, const Uncertain<D>& atom, const Centre<D>& centre) const {
    if (!time_tolerance_) return false;
    const Real entry = atom.time_of(centre), chord = sqrt(real(Z(atom.rho2() - centre.h2)));
    return time - entry <= Real(*time_tolerance_) * entry &&
           time * real(atom.view().velocity.v2) <= real(centre.s) + chord;
  }

  const PerturbedQuery<D>& query_;
  const Answer& exact_;
  const double ulps_;
  std::optional<double> time_tolerance_;
  const bool pass_around_;
  bool used_tolerance_ = false;
  Departure needed_;
  std::size_t passed_over_ = 0;
};

}  // namespace lorentz::oracle
