// Starts that lie in no obstacle, and the oracle of a scene.
#pragma once

#include <lorentz/oracle.hpp>
#include <lorentz/query.hpp>
#include "cases/random.hpp"

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

}  // namespace lorentz::cases
