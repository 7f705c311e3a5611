// Widths of a lattice's corridors and channels.
#pragma once

#include <lorentz/scene.hpp>
#include "cases/integer_vectors.hpp"

namespace lorentz::cases {

/// The cell's area (2D) or volume (3D).
double volume(const Lattice& lattice, int dimension);

/// Half the width of the corridor along the primitive lattice vector (2D), or of the channel between the
/// lattice planes (3D), with these indices, if the obstacles were points.
double half_width(const Lattice& lattice, int dimension, const IntVec& indices);

}  // namespace lorentz::cases
