// A scene of balls with equivalent shadows: a cylinder is open in both scenes or in neither. Private to
// oracle/.
#pragma once

#include <string>
#include <vector>

#include "oracle/horizon/channel_scene.hpp"

namespace lorentz::oracle {

/// The obstacles as balls. Balls stay as they are. If the obstacles are ellipsoids of one shape A, all points
/// are mapped by |det A| A^-1.
struct BallScene {
  ObstacleLattice<3> lattice;
  std::array<ZVec<3>, 3> rows;     ///< rows of the map; the identity for balls
  std::array<ZVec<3>, 3> axes;     ///< those of the largest ball, or of the ellipsoids, before the map
  std::vector<ZVec<3>> positions;  ///< those of the obstacles, before the map
  bool mapped = false;
  std::string unsupported;

  ZVec<3> map(const ZVec<3>& a) const { return {dot(rows[0], a), dot(rows[1], a), dot(rows[2], a)}; }
};

/// The obstacles of all lattices, if these have the same vectors; otherwise sets `unsupported`.
BallScene balls_of(const ChannelScene<3>& scene);

}  // namespace lorentz::oracle
