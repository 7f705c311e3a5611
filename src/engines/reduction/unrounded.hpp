// What double-double cannot decide among the balls of the unit lattices, whose places are exact: the large terms
// are summed without rounding. Private to the reduction engine.
#pragma once

#include "src/engines/reduction/found.hpp"
#include "src/engines/reduction/one_flight.hpp"

namespace lorentz {

/// v x d and v . d for d = N + home, where the large terms cancel before anything is rounded. They err by at
/// most kCross u^2 of themselves and of |v| (|home| + kFromOrigin). False if N is beyond 2^76, or beyond 2^61 and
/// not nearly parallel to v. `along` may be null.
bool set_cross(const double (&v)[3], const Wide (&N)[3], const Vec& home, Wide (&cross)[3], Wide* along);

/// Across 0, across 1 and along (frame_3d-inl.hpp, before they are scaled) of d, the along less `begin`, from
/// set_cross; NaN where that fails. They err by kUnroundedPlace u of the across, and of the along, beside what
/// set_cross grants |v|. For turned velocities.
void unrounded_place(const double (&v)[3], const Wide (&N)[3], const Vec& home, double begin, Vec& place);

/// r^2 |v|^2 - |v x d|^2 and a bound on its error: from set_cross.
double close_slack(const double (&v)[3], const Wide (&N)[3], const Vec& home, double r, double& error);

/// Is a line in the direction v, through the start of a lattice whose home cell is at `home`, farther than r
/// from all lattice points because it stays between two lattice planes? If a vector w with components up to
/// kShortVector is nearly parallel to v, and v lies in a plane of short lattice vectors, the normal of that
/// plane is the direction of w x v. (False where no such w is found.)
bool stays_between_planes(const double (&v)[3], const Vec& home, double r);

/// The same for the planes of the lattice vectors a and b.
bool stays_between_planes(const double (&v)[3], const Vec& home, double r, const Vec& a, const Vec& b);

/// Decides whether the ball of cell N is met where `close` does not.
template <int D>
[[gnu::noinline]] void look_with_integers(const double (&v)[D], const Wide (&N)[D],
                                          const Offset<SplitProduct, D>& offset, double r,
                                          CloseLook<SplitProduct>& close) {
  if (close.is_missed || close.is_met) return;
  double velocity[3] = {}, error;
  Wide cell[3] = {0, 0, 0};
  Vec home{};
  for (int k = 0; k < D; ++k) velocity[k] = v[k], cell[k] = N[k], home[k] = offset.d[k].hi;
  close.slack = close_slack(velocity, cell, home, r, error);
  close.slack_error = error + kRoundoff * std::fabs(close.slack);
  close.is_missed = close.slack<-error, close.is_met = close.slack> error;
}

}  // namespace lorentz
