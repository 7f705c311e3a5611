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
  ZMatrix<3> map;                  ///< the identity for balls
  std::vector<Obstacle<3>> given;  ///< the obstacles before the map, in the same order
  std::string unsupported;
};

/// The obstacles of all lattices, if these have the same vectors; otherwise sets `unsupported`.
BallScene balls_of(const ChannelScene<3>& scene);

}  // namespace lorentz::oracle
