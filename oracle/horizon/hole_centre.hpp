// Where in a hole of a shadow there is room, for a line to be named, and how much: the place is found in
// binary64, and how far it is from the discs is exact. Private to oracle/.
#pragma once

#include "oracle/exact/quadratic.hpp"
#include "oracle/horizon/shadow.hpp"

namespace lorentz::oracle {

struct HoleCentre {
  Vec offset{};  ///< from the centre of the ball `disc` of the HolePoint, perpendicular to g, rounded; in
                 ///< units of the largest ball's radius
  Quadratic clearance;  ///< of the line that `offset` is rounded from: how far it is from the nearest ball
};

/// Climbs from a point of the hole, or of its boundary, away from the discs. The clearance is above 0 unless
/// the hole is too small for the point's bits.
HoleCentre centre_of(const Shadow& shadow, const HolePoint& hole);

}  // namespace lorentz::oracle
