// The exact geometry of one flight and the obstacles of one atom. Private to oracle/.
//
// Everything here is in coordinates in which the atom's obstacles are balls (BallFrame). Symbols: c a centre
// relative to x; s = v.c (along), h = v x c (across), so s^2 + |h|^2 = v^2 |c|^2; rho = r
// |v|. The line meets the open ball iff |h| < rho, and then enters it at t = (s - sqrt(D)) / v^2, D = rho^2 -
// |h|^2. It enters at t >= 0 iff besides s > 0 and |c| >= r (x outside or on the surface).
#pragma once

#include <optional>
#include <tuple>

#include "oracle/exact/exact_problem.hpp"
#include "oracle/exact/quadratic.hpp"

namespace lorentz::oracle {

/// An entry at t = (s - sqrt(d)) / v2 into the obstacle with coordinates n. v2 differs from atom to atom if
/// their obstacles are balls in different coordinates; t does not.
template <std::size_t D>
struct Entry {
  Z s, d, v2;
  ZVec<D> n;
  int lattice = 0, atom = 0;
};

/// The earliest entry so far; of several at the same time, the smallest (lattice, atom, n).
template <std::size_t D>
class Earliest {
 public:
  bool found() const { return entry_.has_value(); }
  const Entry<D>& entry() const { return *entry_; }

  /// True if an entry at (s - sqrt(d)) / v2 would come after the earliest one.
  bool beats(const Z& s, const Z& d, const Z& v2) const {
    return entry_ && compare_entries(entry_->s, entry_->d, entry_->v2, s, d, v2) < 0;
  }

  /// No obstacle whose centre has an s above this, in a view with this v2, can be entered before or with the
  /// earliest one: such an entry needs (s - rho) / v2 < s_best / v2_best.
  Z reach(const Z& rho_above, const Z& v2) const {
    return (v2 == entry_->v2 ? entry_->s : ceil_div(entry_->s * v2, entry_->v2)) + rho_above;
  }

  void offer(Entry<D> other) {
    if (entry_) {
      const int order = compare_entries(other.s, other.d, other.v2, entry_->s, entry_->d, entry_->v2);
      if (order > 0 || (order == 0 && key(*entry_) <= key(other))) return;
    }
    entry_ = std::move(other);
  }

 private:
  static auto key(const Entry<D>& e) { return std::tie(e.lattice, e.atom, e.n); }
  std::optional<Entry<D>> entry_;
};

/// What the search for one atom's first obstacle needs throughout.
template <std::size_t D>
struct Search {
  const View<D>& view;
  const Velocity<D>& velocity;  ///< the view's
  int lattice, atom;
  const ZVec<D>* from;  ///< coordinates of the obstacle to ignore, or null
  Z rho2;               ///< r^2 v^2
  Z rho;  ///< largest integer below rho: |h| <= rho for the integer h of an obstacle that is met
  Earliest<D>& earliest;
};

/// The quadratic functions of k along a row, c(k) = start + k step:
///   |c|^2 = cc + 2 k cg + k^2 gg,   s = s0 + k sg,   |h|^2 = C + 2 k B + k^2 A.
template <std::size_t D>
struct Row {
  Z cc, cg, gg, s0, sg, A, B, C;

  Row(const Velocity<D>& velocity, const LatticePoint<D>& start, const LatticePoint<D>& step)
      : cc(dot(start.p, start.p)),
        cg(dot(start.p, step.p)),
        gg(dot(step.p, step.p)),
        s0(dot(velocity.v, start.p)),
        sg(dot(velocity.v, step.p)),
        A(velocity.v2 * gg - sg * sg),
        B(velocity.v2 * cg - s0 * sg),
        C(velocity.v2 * cc - s0 * s0) {}
};

/// Offers the earliest entry at t >= 0 among the obstacles at start + k step, k any integer. x must lie in
/// none of them but `from`. Costs the same for two obstacles and for 2^1000.
template <std::size_t D>
void offer_first_on_row(const Search<D>& search, const LatticePoint<D>& start, const LatticePoint<D>& step);

}  // namespace lorentz::oracle
