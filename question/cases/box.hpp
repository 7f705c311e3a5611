// A box of cells, and points in it.
#pragma once

#include <lorentz/scene.hpp>
#include "question/cases/random.hpp"

namespace lorentz::cases {

/// A parallelepiped: its edges are `cells[i]` times `vectors[i]`, and it begins at `corner`.
struct Box {
  static constexpr std::uint64_t kCells = 1000;  ///< default number of cells in the box of a superposition

  int dimension = 0;
  std::array<Vec, 3> vectors{};
  Vec cells{1, 1, 1};
  Vec corner{};

  /// One cell of the scene's first lattice.
  static Box cell_of(const Scene& scene) { return {scene.dimension, scene.lattices[0].vectors, {1, 1, 1}}; }

  /// The box in which starts are drawn. For one crystal lattice it is one cell. A superposition has no cell
  /// of its own: its box is about `cells` cells of the first lattice (1000: 40 by 25, or 10 by 10 by 10). If
  /// a lattice repeats in fewer directions, the box surrounds the lattices that repeat in the fewest: it
  /// spans one period in their directions. In the others it spans all obstacles that do not repeat there, and
  /// on either side as much again as the longest primitive vector or the largest obstacle.
  static Box of(const Scene& scene, std::uint64_t cells = kCells);

  /// A point drawn uniformly in the box, up to rounding.
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
