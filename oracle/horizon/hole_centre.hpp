// Where in a hole of a shadow there is room, roughly: in binary64, for a line to be named. Nothing is decided
// here. Private to oracle/.
#pragma once

#include "oracle/horizon/shadow.hpp"

namespace lorentz::oracle {

/// Lengths in units of the largest ball's radius.
struct HoleCentre {
  Vec offset{};          ///< from the centre of the ball `disc` of the HolePoint, perpendicular to g
  double clearance = 0;  ///< distance from the nearest disc
};

/// Climbs from a point of the hole, or of its boundary, away from the discs.
HoleCentre centre_of(const Shadow& shadow, const HolePoint& hole);

}  // namespace lorentz::oracle
