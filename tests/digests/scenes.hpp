// Scenes defined in code, so that the digests need no files.
#pragma once

#include <lorentz/scene.hpp>

namespace lorentz::digests {

inline Scene square(double radius) {
  return unit_scene(2, radius);
}

/// An oblique lattice with two discs of different sizes.
Scene oblique_motif();

/// The square lattice and a copy of it rotated by about pi / 5.
Scene superposition();

/// Tilted ellipses and ellipsoids in lattices without right angles.
Scene leaning_ellipses();
Scene leaning_ellipsoids();

/// A hexagonal lattice with two spheres per cell.
Scene close_packing();

}  // namespace lorentz::digests
