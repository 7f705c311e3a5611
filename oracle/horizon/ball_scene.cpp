#include "oracle/horizon/ball_scene.hpp"

#include <algorithm>

#include "oracle/exact/shape.hpp"

namespace lorentz::oracle {

BallScene balls_of(const ChannelScene<3>& scene) {
  BallScene result{scene.lattices[0], multiple_of_identity<3>(1), {}, {}};
  ObstacleLattice<3>& lattice = result.lattice;
  std::vector<Obstacle<3>>& obstacles = lattice.obstacles;
  for (std::size_t l = 1; l < scene.lattices.size(); ++l) {
    const auto& other = scene.lattices[l];
    if (other.vectors != lattice.vectors) result.unsupported = "done for one lattice only, or equal ones";
    obstacles.insert(obstacles.end(), other.obstacles.begin(), other.obstacles.end());
  }
  lattice.sort_obstacles();
  result.given = obstacles;
  const ZMatrix<3> axes = obstacles[0].axes, shape = shape_of<3>(axes);
  if (std::ranges::all_of(obstacles, &Obstacle<3>::ball)) return result;
  if (!std::ranges::all_of(obstacles, [&](const auto& one) { return shape_of<3>(one.axes) == shape; })) {
    result.unsupported = "done for balls only, or ellipsoids of one shape and orientation";
    return result;
  }
  result.map = adjugate(axes);
  const Z det = dot(result.map[0], axes[0]);
  for (auto& row : result.map) row = Z(sgn(det)) * row;
  for (auto& u : lattice.vectors) u = result.map * u;
  for (auto& one : obstacles) one = {result.map * one.position, multiple_of_identity<3>(abs(det)), true};
  lattice.set_cofactors();
  return result;
}

}  // namespace lorentz::oracle
