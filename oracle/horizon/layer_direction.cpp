// The shadow of a layer along a direction is that of the crystal whose third vector has this direction.
#include <lorentz/horizon.hpp>

#include <algorithm>
#include <cmath>

#include <lorentz/errors.hpp>
#include <lorentz/scene_check.hpp>
#include "oracle/exact/dependence.hpp"
#include "oracle/horizon/shadow_hole.hpp"

namespace lorentz::oracle {
namespace {

constexpr double kMostBeside = 20'000;

Scene crystal_along(const Scene& scene, const Vec& direction) {
  if (!std::all_of(direction.begin(), direction.end(),
                   [](double component) { return std::isfinite(component); }) ||
      direction == Vec{})
    throw InputError("direction: needs three finite numbers that are not all 0");
  Scene crystal = scene;
  for (Lattice& lattice : crystal.lattices) {
    if (scene.dimension != 3 || lattice.rank(3) != 2) throw InputError("direction: supports layers only");
    lattice.vectors[2] = direction;
    lattice.missing = 0;
  }
  return crystal;
}

// The number of discs that meet one disc of the shadow, if all were as large as the largest one.
double neighbours_of(const ObstacleLattice<3>& lattice, const Shadow& shadow) {
  const Z& r = lattice.obstacles[0].axes[0][0];
  const double discs = static_cast<double>(lattice.obstacles.size());
  const Z cell = dot(shadow.along, cross(shadow.basis[0].p, shadow.basis[1].p));
  return discs * std::exp2(2 + log2_of(r) * 2 + 1.5 * log2_of(shadow.along2) - log2_of(cell)) * M_PI;
}

}  // namespace

OpenDirection look_along(const Scene& scene, const Vec& direction) {
  const Scene crystal = crystal_along(checked_exactly(scene), direction);
  if (dependence_of(crystal)) return {true, {}};
  const ChannelScene<3> exact(crystal, 0);
  const BallScene balls = balls_of(exact);
  if (!balls.unsupported.empty()) throw InputError("direction: " + balls.unsupported);
  const auto& given = exact.lattices[0].given;
  Shadow shadow(balls.lattice, balls.map * given[2], balls.map * given[0], balls.map * given[1]);
  if (!hole_of_largest(shadow)) return {};
  if (balls.lattice.obstacles.size() > 1 && neighbours_of(balls.lattice, shadow) > kMostBeside)
    throw InputError("direction: so nearly along the layer that too many obstacles lie beside each other");
  std::size_t work = 0;
  const std::optional<HolePoint> hole = hole_of(shadow, balls.lattice, work);
  if (!hole) return {};
  OpenDirection result{true, cylinder_in(*hole, shadow, balls, exact.exponent, work)};
  result.way->vector = direction;
  return result;
}

}  // namespace lorentz::oracle
