// Flights among lattices that repeat in fewer directions than there are: they pass a bounded stretch, or run
// along a lattice for ever. Private to oracle/.
#pragma once

#include <lorentz/margin.hpp>
#include "oracle/margin/perturbed_query.hpp"

namespace lorentz::oracle {

/// Are all lattices such?
template <std::size_t D>
bool is_open_everywhere(const ExactScene<D>& scene);

/// The smallest margin of a flight that enters nothing in such a scene: of the obstacles that it misses, and
/// of those that nearly contain its start. Along a lattice margins fall with the distance; then the smallest
/// is that of the obstacles that were looked at.
template <std::size_t D>
HardestDecision hardest_miss(const PerturbedQuery<D>& perturbed, long budget);

}  // namespace lorentz::oracle
