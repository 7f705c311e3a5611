// A box of cells, and points in it.
#pragma once

#include <lorentz/scene.hpp>
#include "cases/random.hpp"

namespace lorentz::cases {

/// The parallelepiped that the first lattice's primitive vectors span, so many times each; or another one.
struct Box {
  static constexpr std::uint64_t kCells = 1000;  ///< of a superposition's, unless told otherwise

  int dimension = 0;
  std::array<Vec, 3> vectors{};
  Vec cells{1, 1, 1};
  Vec corner{};

  /// One cell of the scene's first lattice.
  static Box cell_of(const Scene& scene) { return {scene.dimension, scene.lattices[0].vectors, {1, 1, 1}}; }

  /// Where starts are drawn: a cell, but of a superposition, which has none of its own, about so many of the
  /// first lattice. 1000: 40 by 25, or 10 by 10 by 10. Where a lattice repeats in fewer directions the box is
  /// one around what repeats in the fewest: in these directions a period, in the others what there is of such
  /// obstacles and as much again on either side as the longest primitive vector or the largest obstacle.
  static Box of(const Scene& scene, std::uint64_t cells = kCells);

  /// Uniform in it, up to rounding.
  Vec point(Random& random) const {
    Vec x = corner;
    for (int i = 0; i < dimension; ++i) {
      const double share = cells[i] * random.uniform();
      for (int k = 0; k < dimension; ++k) x[k] += share * vectors[i][k];
    }
    return x;
  }
};

}  // namespace lorentz::cases
