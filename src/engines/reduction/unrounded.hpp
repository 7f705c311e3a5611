// What double-double cannot decide among the balls of the unit lattices, whose places are exact: in arithmetic
// without rounding. Private to the reduction engine.
#pragma once

#include "src/engines/reduction/found.hpp"
#include "src/engines/reduction/one_flight.hpp"

namespace lorentz {

/// r^2 |v|^2 - |v x d|^2 for the ball at d = N + home, from a velocity without tiny components. The sign is
/// right, and the error at most 4 u of it; 0 if that is not certain.
double unrounded_slack(int dimension, const double* v, const Wide* N, const double* home, double r);

/// Across 0, across 1 and along (frame_3d-inl.hpp, before they are scaled) of d = N + home, the along less
/// `begin`; each errs by at most 4 u of itself, or is NaN where that is not certain. For turned velocities.
void unrounded_place(const double (&v)[3], const Wide (&N)[3], const Vec& home, double begin, Vec& place);

/// Is a line in the direction v, through the start of a lattice whose home cell is at `home`, farther than r
/// from all lattice points because it stays between two lattice planes? If a vector w with components up to
/// kShortVector is nearly parallel to v, and v lies in a plane of short lattice vectors, the normal of that
/// plane is the direction of w x v. (False where no such w is found.)
bool stays_between_planes(const double (&v)[3], const Vec& home, double r);

/// The same for the planes of the lattice vectors a and b.
bool stays_between_planes(const double (&v)[3], const Vec& home, double r, const Vec& a, const Vec& b);

template <int D>
double unrounded_slack(const double (&v)[D], const Wide (&N)[D], const Offset<SplitProduct, D>& offset,
                       double r) {
  double home[D];
  for (int k = 0; k < D; ++k) home[k] = offset.d[k].hi;
  return unrounded_slack(D, v, N, home, r);
}

/// Decides whether the ball of cell N is met where `close` does not.
template <int D>
[[gnu::noinline]] void look_unrounded(const double (&v)[D], const Wide (&N)[D],
                                      const Offset<SplitProduct, D>& offset, double r,
                                      CloseLook<SplitProduct>& close) {
  const double slack = unrounded_slack(v, N, offset, r);
  close.is_missed = slack<0, close.is_met = slack> 0;
  close.slack = slack, close.slack_error = 4 * kRoundoff * slack;
}

}  // namespace lorentz
