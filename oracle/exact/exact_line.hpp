// The exact geometry of one flight and the obstacles of one atom. Private to oracle/.
//
// Everything here is in coordinates in which the atom's obstacles are balls (BallFrame). Symbols: c is a
// centre relative to x; s = v.c (along) and h = v x c (across), so s^2 + |h|^2 = v^2 |c|^2; rho = r |v|. The
// line meets the open ball iff |h| < rho, and then enters it at t = (s - sqrt(D)) / v^2, D = rho^2 - |h|^2.
// The entry is at t >= 0 iff also s > 0 and |c| >= r (x is outside or on the surface).
#pragma once

#include <optional>
#include <tuple>

#include "oracle/exact/exact_problem.hpp"
#include "oracle/exact/quadratic.hpp"

namespace lorentz::oracle {

/// An entry at t = (s - sqrt(d)) / v2 into the obstacle with coordinates n. v2 differs between atoms whose
/// obstacles are balls in different coordinates; t does not.
template <std::size_t D>
struct ExactEntry {
  Z s, d, v2;
  ZVec<D> n;
  int lattice = 0, atom = 0;
};

/// The earliest entry so far; among several at the same time, the one with the smallest (lattice, atom, n).
template <std::size_t D>
class Earliest {
 public:
  bool found() const { return entry_.has_value(); }
  const ExactEntry<D>& entry() const { return *entry_; }

  /// Negative, 0 or positive if an entry at (s - sqrt(d)) / v2 comes before the earliest one, with it or
  /// after it.
  int order_of(const Z& s, const Z& d, const Z& v2) const {
    return entry_ ? compare_entries(s, d, v2, entry_->s, entry_->d, entry_->v2) : -1;
  }

  /// In a view with this v2, an obstacle whose centre has an s above this cannot be entered before or
  /// together with the earliest one: such an entry needs (s - rho) / v2 < t_best.
  Z reach(const Z& rho_above, const Z& v2) const {
    return (v2 == entry_->v2 ? until_ : ceil_div(until_ * v2, entry_->v2)) + rho_above;
  }

  /// `order` is the order of its time (order_of), and must not be positive.
  void offer(ExactEntry<D> other, int order) {
    if (order == 0 && key(*entry_) <= key(other)) return;
    until_ = other.s;
    entry_ = std::move(other);
  }

  /// Before the search for another atom, whose obstacles may be much smaller: v2 t, rounded up.
  void tighten() {
    if (entry_) until_ = entry_->s - root_below(entry_->d);
  }

 private:
  static auto key(const ExactEntry<D>& e) { return std::tie(e.lattice, e.atom, e.n); }
  std::optional<ExactEntry<D>> entry_;
  Z until_;  // at least v2 times its t
};

/// The data that the search for one atom's first obstacle needs throughout.
template <std::size_t D>
struct Search {
  const View<D>& view;
  const ExactVelocity<D>& velocity;  ///< the view's
  int lattice, atom;
  const ZVec<D>* from;  ///< coordinates of the obstacle to ignore, or null
  Z rho2;               ///< r^2 v^2
  Z rho;  ///< largest integer below rho; |h| <= rho for the integer h of an obstacle that is met
  Earliest<D>& earliest;
};

/// A vector of the plane in coordinates along and across the flight: v^2 |c|^2 = s^2 + h^2.
struct FlightPoint {
  Z s, h;
  ZVec<2> n;

  FlightPoint(const ExactVelocity<2>& velocity, const LatticePoint<2>& point)
      : s(dot(velocity.v, point.p)), h(cross(velocity.v, point.p)), n(point.n) {}
  void add_multiple(const Z& k, const FlightPoint& other) {
    s.add_product(k, other.s);
    h.add_product(k, other.h);
    for (std::size_t i = 0; i < 2; ++i) n[i].add_product(k, other.n[i]);
  }
  void negate();
};

/// The quadratic functions of k along a row, c(k) = start + k step:
///   v^2 |c|^2 = cc + 2 k cg + k^2 gg,   s = s0 + k sg,   |h|^2 = C + 2 k B + k^2 A.
template <std::size_t D>
struct ExactRow {
  Z cc, cg, gg, s0, sg, A, B, C;

  /// A row that begins nowhere yet.
  ExactRow(const ExactVelocity<D>& velocity, const LatticePoint<D>& step)
      : gg(velocity.v2 * dot(step.p, step.p)), sg(dot(velocity.v, step.p)), A(gg - sg * sg) {}
  ExactRow(const ExactVelocity<D>& velocity, const LatticePoint<D>& start, const LatticePoint<D>& step)
      : ExactRow(velocity, step) {
    begin_at(velocity, start, step);
  }
  void begin_at(const ExactVelocity<D>& velocity, const LatticePoint<D>& start, const LatticePoint<D>& step) {
    cc = velocity.v2 * dot(start.p, start.p), cg = velocity.v2 * dot(start.p, step.p);
    s0 = dot(velocity.v, start.p);
    B = cg - s0 * sg, C = cc - s0 * s0;
  }
};

/// All rows with the same step, in the plane. For a row start + k step, k any integer, `offer_first` offers
/// the earliest entry at t >= 0; obstacles that contain x have none. The cost is the same for two obstacles and
/// for 2^1000.
class RowsInPlane {
 public:
  RowsInPlane(const Search<2>& search, const FlightPoint& step);
  void offer_first(const FlightPoint& start) const;

 private:
  const Search<2>& search_;
  const FlightPoint& step_;
  const Z gap_;       // |h| of the step
  const bool short_;  // at most a few points of a row are within rho of the line
};

/// The same in space.
class RowsInSpace {
 public:
  RowsInSpace(const Search<3>& search, const LatticePoint<3>& step);
  void offer_first(const LatticePoint<3>& start) const;

 private:
  const Search<3>& search_;
  const LatticePoint<3>& step_;
  const Z sg_, A_;     // as in ExactRow
  const ZVec<3> h_g_;  // v x step
  Z most_along_;       // |A k + B| is at most this, and ..
  Z most_beside_;      // .. |h_g . start| is at most this, if any obstacle of the row is met
  bool short_;         // at most about kFew values of k are candidates
};

}  // namespace lorentz::oracle
