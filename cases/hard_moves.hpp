// How a drawn query becomes a hard one, in any scene.
//
// move_to_edge draws with std::exp2, which libraries round differently: its bits, and those of the families'
// grazing flights in crystals, superpositions and ellipsoids, are the same only where that is.
#pragma once

#include <lorentz/claim.hpp>
#include <lorentz/oracle.hpp>
#include "cases/random.hpp"

namespace lorentz::cases {

/// A direction of integers from -4 to 4, each nonzero component moved by up to 3 ulps.
Vec near_integer_direction(Random& random, int dimension, NumberFormat precision = NumberFormat::binary64);

/// Moves the start across the line, so that the obstacle that is hit first is passed or met within 2^-10 to
/// 2^-50 (in binary32 2^-21) of its size of its edge. False: the start is then in an obstacle, or nothing was
/// hit.
bool move_to_edge(Random& random, const Scene& scene, const oracle::Oracle& oracle, Query& query,
                  NumberFormat precision = NumberFormat::binary64);

/// The same, beyond the edge by `off_edge` of the obstacle's size; below 0, so that it is met.
bool move_to_edge(double off_edge, const Scene& scene, const oracle::Oracle& oracle, Query& query);

}  // namespace lorentz::cases
