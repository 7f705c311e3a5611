// The mean free path between collisions has a closed form at every radius: (volume of the free part) /
// (cross-section of an obstacle) per cell. 2D: (1 - pi r^2) / (2 r); 3D: (1 - 4 pi r^3 / 3) / (pi r^2).
#include <catch2/catch.hpp>

#include <numbers>

#include <lorentz/oracle.hpp>
#include "question/starts/candidates.hpp"

using namespace lorentz;

namespace {

struct Mean {
  double value, error;
};

// Flights from collision to collision.
Mean mean_free_path(int dimension, double r, int count, std::uint64_t seed) {
  const Scene scene = unit_scene(dimension, r);
  const oracle::Oracle oracle(scene);
  const starts::Candidates starts(scene, flights::Ensemble::surface, seed);
  Query query;
  double sum = 0, sum2 = 0;
  for (int i = 0; i < count; ++i) {
    starts.draw(static_cast<std::uint64_t>(i), 0, query);
    const Answer answer = oracle.first_hit(query);
    REQUIRE(answer.outcome == Outcome::hit);
    sum += *answer.time;
    sum2 += *answer.time * *answer.time;
  }
  const double mean = sum / count;
  return {mean, std::sqrt((sum2 / count - mean * mean) / count)};
}

}  // namespace

TEST_CASE("Mean free path in 2D", "[engines][free_path]") {
  // The variance is infinite (open corridors), so the estimated error is a lower bound; 5 of it are allowed.
  for (const double r : {0.4, 0.2, 0.05}) {
    const Mean mean = mean_free_path(2, r, 40000, 7001);
    const double expected = (1 - std::numbers::pi * r * r) / (2 * r);
    INFO("r = " << r << ": " << mean.value << " +- " << mean.error << ", closed form " << expected);
    CHECK(std::fabs(mean.value - expected) < 5 * mean.error);
    CHECK(mean.error < 0.02 * expected);
  }
}

TEST_CASE("Mean free path in 3D", "[engines][free_path]") {
  for (const double r : {0.4, 0.2}) {
    const Mean mean = mean_free_path(3, r, 15000, 7002);
    const double expected = (1 - 4 * std::numbers::pi * r * r * r / 3) / (std::numbers::pi * r * r);
    INFO("r = " << r << ": " << mean.value << " +- " << mean.error << ", closed form " << expected);
    CHECK(std::fabs(mean.value - expected) < 5 * mean.error);
    CHECK(mean.error < 0.03 * expected);
  }
}
