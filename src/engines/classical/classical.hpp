// The classical algorithm for the unit square and cubic lattice: from cell to cell, with one obstacle in the
// middle of each.
#pragma once

#include <lorentz/engine.hpp>

namespace lorentz {

/// Follows the particle through the cells [-1/2, 1/2)^d in binary64. In each it solves the quadratic for the
/// cell's obstacle; if there is no hit, it moves to the nearest wall and resets the position there. The cost
/// is proportional to the free path, and rounding errors add up with every cell. It cannot establish `never`:
/// after kMaxCells cells the answer is `undecided`.
class Classical : public Engine {
 public:
  static constexpr long kMaxCells = 10'000'000;

  /// For unit scenes with radius <= 1/2.
  explicit Classical(const Scene& scene) : Engine(scene) {}

 private:
  void first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const override {
    answer = flight_of(ray, max_time);
  }
  Answer flight_of(const Ray& ray, double max_time) const;
};

}  // namespace lorentz
