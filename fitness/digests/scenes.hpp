// Scenes that are written down here, so that what is computed in them needs no file.
#pragma once

#include <lorentz/scene.hpp>

namespace lorentz::fitness {

inline Scene square(double radius) {
  return unit_scene(2, radius);
}

/// An oblique lattice with two discs of different sizes.
Scene oblique_motif();

/// The square lattice, and the same turned by about pi / 5.
Scene superposition();

/// Ellipses and ellipsoids that lean, in lattices without right angles.
Scene leaning_ellipses();
Scene leaning_ellipsoids();

/// Hexagonal, two spheres a cell.
Scene close_packing();

}  // namespace lorentz::fitness
