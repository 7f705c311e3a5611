// How a drawn start becomes a hard one, in any scene.
#pragma once

#include <lorentz/oracle.hpp>
#include "cases/random.hpp"

namespace lorentz::flights {

/// A primitive vector of one of the lattices, components up to 9, or beside it: up to 3 ulps in each nonzero
/// component, or 2^-40 to 2^-52 of its size towards another lattice vector.
Vec near_rational_direction(cases::Random& random, const Scene& scene);

/// Moves the start across its line so that the line passes or meets the obstacle that was hit first within
/// 2^-40 to 2^-52 of its size of its edge. False: nothing was hit, or the start is now in an obstacle.
bool move_to_graze(cases::Random& random, const Scene& scene, const oracle::Oracle& oracle, Query& start);

}  // namespace lorentz::flights
