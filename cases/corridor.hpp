// How wide the corridors of a lattice are.
#pragma once

#include <lorentz/scene.hpp>
#include "cases/integer_vectors.hpp"

namespace lorentz::cases {

/// The cell's area or volume.
double volume(const Lattice& lattice, int dimension);

/// Half the width of the corridor along the primitive lattice vector (2D), or of the channel between the
/// lattice planes (3D) with these indices, if the obstacles were points.
double half_width(const Lattice& lattice, int dimension, const IntVec& indices);

}  // namespace lorentz::cases
