// The classical algorithm: from cell to cell, one obstacle in the middle of each (unit square or cubic
// lattice).
#pragma once

#include <lorentz/engine.hpp>

namespace lorentz {

/// Follows the particle through the cells [-1/2, 1/2)^d in binary64: solves the quadratic for the obstacle of
/// the cell, else moves to the nearest wall and resets the position there. Costs are proportional to the free
/// path, and rounding errors add up with every cell. `never` is beyond it: after kMaxCells it says
/// `undecided`.
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
