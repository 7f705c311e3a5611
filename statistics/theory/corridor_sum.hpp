// The tail constant of one 2D lattice of discs, as a sum in binary64. The exact search lists every corridor,
// which is slow for 10^5 corridors. Private to statistics/theory.
#pragma once

#include <optional>

#include <lorentz/scene.hpp>

namespace lorentz::flights {

struct CorridorSum {
  double value = 0;       ///< C in P(a path from a uniform start > t) ~ C / t; 0 without a corridor
  bool of_limit = false;  ///< true: not the sum over corridors, which would be millions, but its limit
                          ///< r -> 0, which then differs by less than 1e-5
};

/// For a lattice with one disc that does not overlap its translates. Empty if there are millions of corridors
/// but the limit is not close. This happens in a slender cell.
std::optional<CorridorSum> corridor_tail_constant(const Lattice& lattice);

}  // namespace lorentz::flights
