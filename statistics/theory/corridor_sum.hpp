// The tail constant of one 2D lattice of discs, as a sum in binary64: the exact search for corridors names
// each of them, and takes its time where there are 10^5. Private to statistics/theory.
#pragma once

#include <optional>

#include <lorentz/scene.hpp>

namespace lorentz::flights {

struct CorridorSum {
  double value = 0;       ///< C of P(a path from a uniform start > t) ~ C / t; 0 without a corridor
  bool of_limit = false;  ///< not a sum over corridors, of which there would be millions, but its limit
                          ///< r -> 0, which is off by less than 1e-5 then
};

/// For a lattice with one disc, which does not overlap its translates. Nothing if there are millions of
/// corridors and the limit is far nevertheless: in a slender cell.
std::optional<CorridorSum> corridor_tail_constant(const Lattice& lattice);

}  // namespace lorentz::flights
