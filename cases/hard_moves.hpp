// Changes that make a drawn query hard, in any scene.
//
// move_to_edge draws with std::exp2, which libraries round differently. Its bits, and those of the families'
// grazing flights in crystals, superpositions and ellipsoids, are the same only where std::exp2 is the same.
#pragma once

#include <lorentz/claim.hpp>
#include <lorentz/oracle.hpp>
#include "cases/random.hpp"

namespace lorentz::cases {

/// A direction of integers from -4 to 4, each nonzero component moved by up to 3 ulps.
Vec near_integer_direction(Random& random, int dimension, NumberFormat precision = NumberFormat::binary64);

/// Moves the start across the line, so that the line passes or meets the obstacle that is hit first within
/// 2^-10 to 2^-50 (in binary32 2^-21) of the obstacle's size from its edge. False if the start is then in an
/// obstacle, or if nothing was hit.
bool move_to_edge(Random& random, const Scene& scene, const oracle::Oracle& oracle, Query& query,
                  NumberFormat precision = NumberFormat::binary64);

/// The same, but the line passes at `off_edge` of the obstacle's size beyond the edge; if `off_edge` is below
/// 0, it meets the obstacle.
bool move_to_edge(double off_edge, const Scene& scene, const oracle::Oracle& oracle, Query& query);

}  // namespace lorentz::cases
