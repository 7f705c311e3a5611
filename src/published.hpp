// The efficient algorithm of Kraemer, Kryukov and Sanders, "Efficient algorithms for general periodic Lorentz
// gases in two and three dimensions" (J. Phys. A 49, 2016), in binary64 and as published: reconstructed from
// the paper's text and the behaviour of its authors' program of 2015, faults included, because it is what
// users compare against. docs/published.md lists the faults; tests/published_test.cpp holds them fast.
#pragma once

#include "engine.hpp"

namespace lorentz {

/// Unit square and cubic lattice. 2D: convergents of the slope. 3D: the 2D algorithm in the three coordinate
/// planes. Directions along an axis (in 3D: with any zero component) are `unsupported`: the algorithm has no
/// octant for them. A search is `undecided` after kMaxPasses passes or 2^52 columns (2D), after kMaxRounds
/// rounds or beyond kMaxStart (3D).
class Published : public Engine {
 public:
  static constexpr long kMaxPasses = 1'000'000;
  static constexpr long kMaxRounds = 1'000'000;

  /// For unit scenes with radius <= 1/2.
  explicit Published(const Scene& scene) : Engine(scene) {}

 private:
  void first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const override {
    answer = flight_of(ray, max_time);
  }
  Answer flight_of(const Ray& ray, double max_time) const;
};

}  // namespace lorentz
