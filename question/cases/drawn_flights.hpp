// Flights drawn in a scene: starts that lie in no obstacle, hard directions, lines past an obstacle's edge.
//
// drawn_off_edge uses std::exp2, which libraries round differently. Its bits, and those of the families'
// grazing flights in crystals, superpositions and ellipsoids, are the same only where std::exp2 is the same.
#pragma once

#include <functional>

#include <lorentz/claim.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/query.hpp>
#include "question/cases/random.hpp"

namespace lorentz::cases {

/// The oracle for a scene; each thread keeps the last one that it asked for.
const oracle::Oracle& oracle_of(const Scene& scene);

/// Does the query start in an obstacle, other than its `from`? Exact.
bool starts_inside(const Scene& scene, const Query& query);

/// A point drawn uniformly in the cell of the first lattice.
Vec point_in_cell(Random& random, const Scene& scene);

/// The same, in no obstacle; if 20 draws fail, the last point drawn.
Vec free_point(Random& random, const Scene& scene);

/// From a free point in an isotropic direction.
Query free_flight(Random& random, const Scene& scene);

/// A direction of integers from -4 to 4, each nonzero component moved by up to 3 ulps.
Vec near_integer_direction(Random& random, int dimension, NumberFormat precision);

/// Moves the start across the line, so that the line passes the obstacle that is hit first at `off_edge` of
/// the obstacle's size beyond its edge; if that is below 0, it meets the obstacle. Asks for `off_edge` only
/// if something was hit. False if nothing was, or if the start is then in an obstacle.
bool move_to_edge(const std::function<double()>& off_edge, const Scene& scene, const oracle::Oracle& oracle,
                  Query& query, NumberFormat precision = NumberFormat::binary64);

/// 2^-10 to 2^-50 (in binary32 2^-21) of an obstacle's size, on either side of its edge.
double drawn_off_edge(Random& random, NumberFormat precision);

}  // namespace lorentz::cases
