// Flights from collision to collision have the mean that follows from volumes and surfaces (Santalo). Seeds
// are fixed; bounds are 4 standard errors.
#include <catch2/catch.hpp>

#include <numeric>

#include <lorentz/batch.hpp>
#include "question/scene_engine.hpp"
#include "question/starts/candidates.hpp"
#include "src/problem/scene_geometry.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::flights;
using namespace lorentz::starts;
using namespace lorentz::test;

namespace {

struct Mean {
  double value = 0, error = 0;
  long inside = 0, others = 0;  // others: neither a hit nor inside
};

// If a start is inside an obstacle, the next attempt counts.
Mean mean_free_path(const Scene& scene, std::uint64_t seed, std::size_t count) {
  constexpr std::size_t kTogether = 4096;
  const Candidates starts(scene, Ensemble::surface, seed);
  const Batch batch(scene);
  std::vector<std::uint64_t> indices;
  QueryRows rows;
  FlightTable flights;
  Query again;
  Mean mean;
  double sum = 0, sum2 = 0;
  for (std::size_t first = 0; first < count; first += kTogether) {
    const std::size_t together = std::min(kTogether, count - first);
    indices.resize(together);
    std::iota(indices.begin(), indices.end(), first);
    starts.draw(indices, 0, rows);
    flights.resize(together);
    batch.fly(question::view_of(rows), flights.columns());
    for (std::size_t i = 0; i < together; ++i) {
      Flight flight = flights[i];
      for (std::uint64_t attempt = 1; flight.outcome == Outcome::inside; ++attempt, ++mean.inside) {
        REQUIRE(attempt < Candidates::kMostAttempts);
        starts.draw(first + i, attempt, again);
        flight = batch.one_at_a_time().fly(again);
      }
      if (flight.outcome != Outcome::hit) ++mean.others;
      sum += flight.time, sum2 += flight.time * flight.time;
    }
  }
  const auto n = static_cast<double>(count);
  mean.value = sum / n;
  mean.error = std::sqrt((sum2 / n - mean.value * mean.value) / n);
  return mean;
}

}  // namespace

// Where channels are open the second moment diverges, logarithmically: a standard error from the sample then
// settles slowly, though the mean over it still tends to a normal law. So the planar scenes but one have a
// finite horizon.
TEST_CASE("The mean free path off surfaces is Santalo's", "[flights][starts]") {
  constexpr std::size_t kFlights = 1'000'000;
  const auto scenes = all_scenes();
  for (const char* name :
       {"triangular", "ellipses-mixed", "cubic", "diamond", "perovskite", "ellipsoid", "ellipsoids-mixed"}) {
    const Scene& scene = scenes.at(name);
    const double expected = filling_of(scene)->mean_free_path;
    const Mean mean = mean_free_path(scene, 7003, kFlights);
    INFO(name << ": " << mean.value << " +- " << mean.error << ", closed form " << expected);
    CHECK(mean.others == 0);
    CHECK(mean.inside == 0);
    CHECK(mean.error < 0.005 * expected);
    CHECK(std::fabs(mean.value - expected) < 4 * mean.error);
  }
}
