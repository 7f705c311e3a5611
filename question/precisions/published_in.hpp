// The published algorithm in the unit square and cubic lattice, in numbers of any type. Private to this
// folder and its tests.
#pragma once

#include <lorentz/engine_base.hpp>
#include "src/engines/published/published_unit.hpp"

namespace lorentz::question {

template <class T>
class PublishedIn : public Engine {
 public:
  /// For the unit lattice with a radius of at most 1/2.
  explicit PublishedIn(const Scene& scene) : Engine(scene) {}

 private:
  void first_hit_scaled(const Ray& ray, double, Answer& answer) const override {
    Proposals proposals;
    answer = published_search::unit_flight<T>(ray, scene().dimension, scene().lattices[0].atoms[0].radius,
                                              proposals);
    // Binary32 overflows where a slope is below 2^-127.
    if (answer.time && !std::isfinite(*answer.time)) answer = Answer::undecided();
  }
};

}  // namespace lorentz::question
