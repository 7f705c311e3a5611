#include "oracle/horizon/ball_scene.hpp"

#include <algorithm>

#include "oracle/exact/shape.hpp"

namespace lorentz::oracle {

BallScene balls_of(const ChannelScene<3>& scene) {
  BallScene result;
  result.lattice = scene.lattices[0];
  ObstacleLattice<3>& lattice = result.lattice;
  for (std::size_t l = 1; l < scene.lattices.size(); ++l) {
    const auto& other = scene.lattices[l];
    if (other.vectors != lattice.vectors) result.unsupported = "done for one lattice only, or equal ones";
    lattice.obstacles.insert(lattice.obstacles.end(), other.obstacles.begin(), other.obstacles.end());
  }
  bool balls = true, same = true;
  const ZMatrix<3> shape = shape_of<3>(lattice.obstacles[0].axes);
  for (const auto& obstacle : lattice.obstacles) {
    balls &= obstacle.ball;
    same &= shape_of<3>(obstacle.axes) == shape;
  }
  if (balls)
    std::stable_sort(lattice.obstacles.begin(), lattice.obstacles.end(),
                     [](const auto& a, const auto& b) { return a.axes[0][0] > b.axes[0][0]; });
  for (std::size_t i = 0; i < 3; ++i) result.rows[i][i] = 1;
  for (const auto& obstacle : lattice.obstacles) result.positions.push_back(obstacle.position);
  result.axes = lattice.obstacles[0].axes;
  if (!balls && !same) result.unsupported = "done for balls only, or ellipsoids of one shape and orientation";
  if (balls || !same) return result;
  result.mapped = true;
  const auto& a = result.axes;
  const Z det = dot(cross(a[0], a[1]), a[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    result.rows[i] = cross(a[(i + 1) % 3], a[(i + 2) % 3]);
    if (det < 0)
      for (Z& component : result.rows[i]) component = -component;
  }
  for (auto& u : lattice.vectors) u = result.map(u);
  for (auto& obstacle : lattice.obstacles) {
    obstacle.position = result.map(obstacle.position);
    for (auto& axis : obstacle.axes) axis = {};
    for (std::size_t i = 0; i < 3; ++i) obstacle.axes[i][i] = abs(det);
    obstacle.ball = true;
  }
  set_cofactors<3>(lattice);
  return result;
}

}  // namespace lorentz::oracle
