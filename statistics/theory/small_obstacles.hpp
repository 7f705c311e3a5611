// Scenes with a known limit law: one ball per cell, or 2D lattices with one obstacle per cell each. Private
// to statistics.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lorentz/scene.hpp>

namespace lorentz::flights {

/// The ball of a scene of this dimension with one ball per cell, else null.
const Atom* only_ball(const Scene& scene, int dimension);

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

/// C in P(a path from a uniform start > t) ~ C / t, 0 without a corridor: for a 2D lattice with one disc that does
/// not overlap its translates, as a sum in binary64. (The exact search lists every corridor, which is slow for
/// 10^5.) `of_limit` (if given) becomes true if it is not the sum over corridors, which would be millions, but its
/// limit r -> 0, which then differs by less than 1e-5. Empty if there are millions, but the limit is not close. This
/// happens in a slender cell.
std::optional<double> corridor_tail_constant(const Lattice& lattice, bool* of_limit = nullptr);

}  // namespace lorentz::flights
