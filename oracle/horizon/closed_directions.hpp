// The directions along which rows of obstacles leave no way open. Private to oracle/.
#pragma once

#include <vector>

#include <lorentz/horizon.hpp>

namespace lorentz::oracle {

/// The arcs in the order of their angles. The scene must not be a crystal. Throws InputError if the scene is
/// unsupported: if it has layers, crystals or no rows, rows in different directions in the plane, or too many
/// pairs of obstacles.
std::vector<ClosedArc> closed_directions(const Scene& scene);

}  // namespace lorentz::oracle
