// A box of cells, and points in it.
#pragma once

#include <lorentz/problem.hpp>
#include "cases/random.hpp"

namespace lorentz::cases {

/// The parallelepiped that the first lattice's primitive vectors span, so many times each.
struct Box {
  int dimension = 0;
  std::array<Vec, 3> vectors{};
  Vec cells{1, 1, 1};

  /// One cell of the scene's first lattice.
  static Box cell_of(const Scene& scene) { return {scene.dimension, scene.lattices[0].vectors, {1, 1, 1}}; }

  /// Uniform in it, up to rounding.
  Vec point(Random& random) const {
    Vec x{};
    for (int i = 0; i < dimension; ++i) {
      const double share = cells[i] * random.uniform();
      for (int k = 0; k < dimension; ++k) x[k] += share * vectors[i][k];
    }
    return x;
  }
};

}  // namespace lorentz::cases
