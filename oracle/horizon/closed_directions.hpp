// The directions along which rows of obstacles leave no way open. Private to oracle/.
#pragma once

#include <vector>

#include <lorentz/horizon.hpp>

namespace lorentz::oracle {

/// In the order of their angles. The scene is no crystal. Throws InputError if it is unsupported: if it has
/// layers, crystals or no rows, rows in different directions in the plane, or too many pairs of obstacles.
std::vector<ClosedArc> closed_directions(const Scene& scene);

}  // namespace lorentz::oracle
