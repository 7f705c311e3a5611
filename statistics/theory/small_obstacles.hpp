// Scenes with a known limit law: 2D lattices with one obstacle per cell each. Private to statistics/theory.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lorentz/scene.hpp>

namespace lorentz::flights {

/// The rates for one direction: for each lattice, the width of its obstacle across that direction divided by
/// the area of its cell. A path t is s = rate * t in the lattice's limit law, and the rate is that of
/// collisions.
using Rates = std::vector<double>;

/// One entry per direction, evenly spaced. Discs need only one direction, ellipses so many that sums over the
/// directions approximate integrals.
struct SmallObstacles {
  std::vector<Rates> directions;
  bool discs = true;

  std::size_t lattices() const { return directions[0].size(); }
  double mean_rate() const;  ///< collisions per time, of all lattices, averaged over directions
};

/// Empty if the scene is not of that kind; `why_not` is then the reason.
std::optional<SmallObstacles> small_obstacles_of(const Scene& scene, std::string& why_not);

}  // namespace lorentz::flights
