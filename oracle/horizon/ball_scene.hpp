// A scene of balls with the same shadows: a cylinder is open in both or in neither. Private to oracle/.
#pragma once

#include <string>
#include <vector>

#include "oracle/horizon/channel_scene.hpp"

namespace lorentz::oracle {

/// The obstacles as balls: as they are, or, if they are ellipsoids of one shape A, with all points mapped by
/// |det A| A^-1.
struct BallScene {
  ObstacleLattice<3> lattice;
  std::array<ZVec<3>, 3> rows;     ///< of the map; the identity for balls
  std::array<ZVec<3>, 3> axes;     ///< of the largest ball, or of the ellipsoids, before
  std::vector<ZVec<3>> positions;  ///< of the obstacles before
  bool mapped = false;
  std::string unsupported;

  ZVec<3> map(const ZVec<3>& a) const { return {dot(rows[0], a), dot(rows[1], a), dot(rows[2], a)}; }
};

/// Of all lattices, if they have the same vectors.
BallScene balls_of(const ChannelScene<3>& scene);

}  // namespace lorentz::oracle
