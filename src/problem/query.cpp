#include <lorentz/query.hpp>

#include <cmath>
#include <string>
#include <string_view>

#include <lorentz/errors.hpp>
#include <lorentz/scene.hpp>

#include "src/problem/scene_geometry.hpp"

namespace lorentz {
namespace {

// What is wrong with the obstacle that a particle is said to leave, or nothing.
std::optional<std::string> from_flaw(const ObstacleId& from, const Scene& scene) {
  if (from.lattice < 0 || from.lattice >= static_cast<int>(scene.lattices.size()))
    return "from names lattice " + std::to_string(from.lattice) + ", which the scene does not have";
  if (from.atom < 0 || from.atom >= static_cast<int>(scene.lattices[from.lattice].atoms.size()))
    return "from names atom " + std::to_string(from.atom) + ", which its lattice does not have";
  const auto& lattice = scene.lattices[from.lattice];
  for (int i = lattice.rank_in(scene.dimension); i < 3; ++i)
    if (!(from.cell[i] == Integer(0)))
      return "from names a cell with more coordinates than lattice " + std::to_string(from.lattice) +
             " has vectors";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> flaw_of(const Query& query, const Scene& scene, double max_time) {
  if (std::isnan(max_time)) return "max_time is not a number; without a limit it is infinity";
  if (!all_finite(query.x)) return "x is not finite";
  if (!all_finite(query.v)) return "v is not finite";
  if (scene.dimension == 2 && (query.x[2] != 0 || query.v[2] != 0))
    return "x and v have two components in the plane: the third must be zero";
  if (query.v == Vec{}) return "v is zero: the particle needs a direction";
  return query.from ? from_flaw(*query.from, scene) : std::nullopt;
}

const Query& checked(const Query& query, const Scene& scene) {
  if (const auto flaw = flaw_of(query, scene)) throw InputError("query: " + *flaw);
  return query;
}

const ObstacleId& checked(const ObstacleId& obstacle, const Scene& scene) {
  if (const auto flaw = from_flaw(obstacle, scene))
    throw InputError("obstacle: " + flaw->substr(std::string_view("from ").size()));
  return obstacle;
}

}  // namespace lorentz
