// Scenes of which the limit law is known: 2D lattices with one obstacle a cell each. Private to
// statistics/theory.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lorentz/scene.hpp>

namespace lorentz::flights {

/// Seen in one direction: of each lattice the width of its obstacle across that direction over the area of
/// its cell. A path t is s = rate * t of the lattice's limit law, and the rate is that of collisions.
using Rates = std::vector<double>;

/// One entry a direction, the directions evenly spread: all that there are for discs is one, for ellipses as
/// many as make sums over them integrals.
struct SmallObstacles {
  std::vector<Rates> directions;
  bool discs = true;

  std::size_t lattices() const { return directions[0].size(); }
  double mean_rate() const;  ///< collisions per time, of all lattices, over all directions
};

/// Nothing if the scene is not of that kind, with the reason.
std::optional<SmallObstacles> small_obstacles_of(const Scene& scene, std::string& why_not);

}  // namespace lorentz::flights
