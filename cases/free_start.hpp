// Starts that lie in no obstacle, and the oracle that says what they lead to.
#pragma once

#include <lorentz/oracle.hpp>
#include <lorentz/query.hpp>
#include "cases/random.hpp"

namespace lorentz::cases {

/// The oracle for a scene; each thread keeps the last one.
const oracle::Oracle& oracle_of(const Scene& scene);

/// Does the query start in an obstacle, other than its `from`? Exact.
bool starts_inside(const Scene& scene, const Query& query);

/// Uniform in the cell of the first lattice.
Vec point_in_cell(Random& random, const Scene& scene);

/// The same, in no obstacle; after some tries in vain the last point that was drawn.
Vec free_point(Random& random, const Scene& scene);

}  // namespace lorentz::cases
