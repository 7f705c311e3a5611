// Finds a line with room around it in a hole of a shadow, so that the line can be reported, and how much room
// it has. The place is found in binary64; its distance from the discs is exact. Private to oracle/.
#pragma once

#include "oracle/exact/quadratic.hpp"
#include "oracle/horizon/shadow.hpp"

namespace lorentz::oracle {

struct HoleCentre {
  Vec offset{};  ///< from the centre of the ball `disc` of the HolePoint, perpendicular to g, rounded; in
                 ///< units of the largest ball's radius
  Quadratic clearance;  ///< distance of the line that `offset` is rounded from to the nearest ball
};

/// Climbs from a point of the hole, or of its boundary, away from the discs. The clearance is above 0 unless
/// the hole is too small for the bits of the point.
HoleCentre centre_of(const Shadow& shadow, const HolePoint& hole);

}  // namespace lorentz::oracle
