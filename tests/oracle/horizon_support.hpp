// Scenes for the tests of the horizon.
#pragma once

#include <cmath>

#include <lorentz/obstacle.hpp>
#include <lorentz/scene.hpp>
#include "tests/support/support.hpp"

namespace lorentz::test {

inline Scene scene_with(int dimension, std::array<Vec, 3> vectors, std::vector<Atom> atoms) {
  Scene scene;
  scene.dimension = dimension;
  scene.lattices.push_back({vectors, std::move(atoms)});
  return scene;
}

inline std::string key_of(const std::array<Integer, 3>& indices) {
  return indices[0].decimal() + " " + indices[1].decimal() + " " + indices[2].decimal();
}

// Numbers of few bits, so that integer combinations of vectors are exact.
inline double short_number(Draw& draw, int range) {
  return draw.fraction(8, range);
}

inline Lattice short_lattice(Draw& draw, int dimension) {
  Lattice lattice;
  do
    for (int i = 0; i < dimension; ++i)
      for (int k = 0; k < dimension; ++k) lattice.vectors[i][k] = short_number(draw, 2);
  while (std::fabs(determinant(lattice, dimension)) < 0.25);
  return lattice;
}

inline Scene short_scene(Draw& draw, int dimension, std::uint64_t most_atoms, double least, double most) {
  Lattice lattice = short_lattice(draw, dimension);
  lattice.atoms.resize(1 + draw.below(most_atoms));
  for (Atom& atom : lattice.atoms) {
    for (int k = 0; k < dimension; ++k) atom.position[k] = short_number(draw, 1);
    atom.radius = std::ldexp(std::round(std::ldexp(draw.between(least, most), 6)), -6);
    if (atom.radius == 0) atom.radius = 0.125;
  }
  Scene scene;
  scene.dimension = dimension;
  scene.lattices.push_back(lattice);
  return scene;
}

}  // namespace lorentz::test
