// Searches for a direction near v in which nothing is ever hit. Private to oracle/.
#pragma once

#include "oracle/margin/perturbed_query.hpp"

namespace lorentz::oracle {

/// True if an open corridor or channel contains x (a corridor or planar channel may miss x by `ulps` ulps),
/// and its direction is within `ulps` ulps of v in every component, where a zero is exact. The directions
/// tried are those of lattice vectors and (3D) of lattice planes, the shortest few near v. Each is decided
/// exactly. x must lie in no obstacle by more than `ulps` ulps.
template <std::size_t D>
bool open_near(const PerturbedQuery<D>& perturbed, double ulps);

}  // namespace lorentz::oracle
