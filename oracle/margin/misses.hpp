// Flights in scenes whose lattices repeat in fewer directions than the space has. Such flights pass a bounded
// stretch of the lattices, or run along a lattice for ever. Private to oracle/.
#pragma once

#include <algorithm>

#include <lorentz/margin.hpp>
#include "oracle/margin/perturbed_query.hpp"

namespace lorentz::oracle {

/// True if all lattices repeat in fewer directions than the space has.
template <std::size_t D>
bool is_open_everywhere(const ExactScene<D>& scene) {
  return std::ranges::all_of(scene.lattices, [](const auto& lattice) { return lattice.rank < D; });
}

/// The smallest margin of a flight that enters nothing in such a scene, over the obstacles that it misses and
/// those that nearly contain its start. Along a lattice, margins fall with the distance; the result is then
/// the smallest margin of the obstacles that were looked at.
template <std::size_t D>
HardestDecision hardest_miss(const PerturbedQuery<D>& perturbed, long budget);

}  // namespace lorentz::oracle
