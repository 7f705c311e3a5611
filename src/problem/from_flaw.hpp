// A check that scenes of binary64 and of rational numbers share. Private to src/problem.
#pragma once

#include <optional>
#include <string>

#include <lorentz/obstacle.hpp>

namespace lorentz {

/// What is wrong with the obstacle that a particle is said to leave, or nothing.
template <class AScene>
std::optional<std::string> from_flaw(const ObstacleId& from, const AScene& scene) {
  if (from.lattice < 0 || from.lattice >= static_cast<int>(scene.lattices.size()))
    return "from names lattice " + std::to_string(from.lattice) + ", which the scene does not have";
  if (from.atom < 0 || from.atom >= static_cast<int>(scene.lattices[from.lattice].atoms.size()))
    return "from names atom " + std::to_string(from.atom) + ", which its lattice does not have";
  const auto& lattice = scene.lattices[from.lattice];
  for (int i = scene.dimension - lattice.missing; i < 3; ++i)
    if (!(from.cell[i] == Integer(0)))
      return "from names a cell with more coordinates than lattice " + std::to_string(from.lattice) +
             " has vectors";
  return std::nullopt;
}

}  // namespace lorentz
