// Plain scenes for the tests.
#pragma once

#include <array>

#include <lorentz/scene.hpp>

namespace lorentz::test {

/// One ball in each cell of the lattice with these vectors.
inline Scene one_atom(int dimension, const std::array<Vec, 3>& vectors, double radius,
                      const Vec& position = {}) {
  Scene scene = unit_scene(dimension, radius);
  scene.lattices[0].vectors = vectors;
  scene.lattices[0].atoms[0].position = position;
  return scene;
}

inline Scene two_lattices() {
  Scene scene = unit_scene(2, 0.1);
  scene.lattices.push_back({{Vec{0.8, 0.6, 0}, {-0.6, 0.8, 0}}, {{{0.1, 0.5, 0}, 0.05, {}}}});
  return scene;
}

/// The scene with all its balls alike.
inline Scene with_radius(Scene scene, double radius) {
  for_each_atom(scene, [&](Atom& atom) { atom.radius = radius; });
  return scene;
}

}  // namespace lorentz::test
