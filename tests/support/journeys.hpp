// What tests of itineraries share: problems in texts, journeys, and all that is told of one.
#pragma once

#include <string>
#include <vector>

#include <lorentz/itinerary.hpp>

namespace lorentz::testing {

inline Rational exact(const std::string& text) {
  return rational_from(text).value();
}

/// The unit square (cubic) lattice.
inline RationalScene unit(int dimension, const std::string& radius) {
  RationalScene scene = rational(unit_scene(dimension, 0.1));
  scene.lattices[0].atoms[0].radius = exact(radius);
  return scene;
}

inline Start start_at(const std::vector<std::string>& x, const std::vector<std::string>& v) {
  Start start;
  for (std::size_t i = 0; i < x.size(); ++i) start.x[i] = exact(x[i]);
  for (std::size_t i = 0; i < v.size(); ++i) start.v[i] = surd_from(v[i]).value();
  return start;
}

inline oracle::Journey until(const std::string& time, int digits = 17) {
  oracle::Journey journey;
  journey.time = exact(time);
  journey.digits = digits;
  return journey;
}

inline oracle::Journey collisions(std::uint64_t count, int digits = 17) {
  oracle::Journey journey;
  journey.collisions = count;
  journey.digits = digits;
  return journey;
}

struct Told {
  std::vector<oracle::CertifiedCollision> collisions;
  oracle::Arrival end;

  std::vector<ObstacleId> word() const {
    std::vector<ObstacleId> obstacles;
    for (const auto& collision : collisions) obstacles.push_back(collision.obstacle);
    return obstacles;
  }
};

inline Told follow(const RationalScene& scene, const Start& start, const oracle::Journey& journey) {
  Told told;
  told.end =
      oracle::Itinerary(scene).follow(start, journey, [&](const oracle::CertifiedCollision& collision) {
        told.collisions.push_back(collision);
        return true;
      });
  return told;
}

}  // namespace lorentz::testing
