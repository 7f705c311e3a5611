// Starts as programs ask about them: free, in the claim's numbers and domain, and as varied as they are said to be.
// Seeds are fixed.
#include <catch2/catch.hpp>

#include <cmath>

#include <lorentz/geometry.hpp>
#include <lorentz/oracle.hpp>
#include "question/starts/varied_starts.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::starts;
using namespace lorentz::test;

namespace {

constexpr std::uint64_t kSeed = 20161115;

bool is_flat(const Query& query, int dimension) {
  for (int i = 0; i < dimension; ++i)
    if (query.v[i] == 0) return true;
  return false;
}

double farthest(const Query& query) {
  return std::max({std::fabs(query.x[0]), std::fabs(query.x[1]), std::fabs(query.x[2])});
}

struct Shares {
  int far = 0, very_far = 0, negative = 0, unit_speed = 0, flat = 0, on_surface = 0, limited = 0;
  double slowest = 1, fastest = 1;
};

Shares shares_in(const Scene& scene, int count) {
  const VariedStarts starts(scene, kSeed);
  Shares its;
  for (int i = 0; i < count; ++i) {
    const auto [query, max_time] = starts[static_cast<std::uint64_t>(i)];
    const double speed = length(query.v);
    its.far += farthest(query) > 2, its.very_far += farthest(query) > 1100;
    its.negative += query.x[0] < 0;
    if (!is_flat(query, scene.dimension)) its.unit_speed += std::fabs(speed - 1) < 1e-9;
    its.flat += is_flat(query, scene.dimension);
    its.on_surface += query.from.has_value();
    its.limited += std::isfinite(max_time);
    its.slowest = std::min(its.slowest, speed), its.fastest = std::max(its.fastest, speed);
  }
  return its;
}

}  // namespace

TEST_CASE("Varied starts lie in no obstacle, in the claim's numbers", "[flights][starts]") {
  for (const char* name : {"square", "triangular", "ellipses-mixed", "overlapping-3d", "superposition-pi-7",
                           "two-balls", "grating", "film"})
    for (const NumberFormat format : {NumberFormat::binary64, NumberFormat::binary32}) {
      const Scene scene = rounded(all_scenes().at(name), format);
      const oracle::Oracle oracle(scene);
      const VariedStarts starts(scene, kSeed, {.precision = format}),
          same(scene, kSeed, {.precision = format}), other(scene, kSeed + 1, {.precision = format});
      int equal = 0;
      for (std::uint64_t i = 0; i < 300; ++i) {
        CAPTURE(name, i);
        const auto [query, max_time] = starts[i];
        REQUIRE_FALSE(flaw_of(query, scene, max_time));
        REQUIRE(consists_of(query, format));
        REQUIRE(rounded(max_time, format) == max_time);
        REQUIRE(oracle.first_hit(query).outcome != Outcome::inside);
        const auto again = same[i], else_where = other[i];
        REQUIRE((again.query.x == query.x && again.query.v == query.v && again.max_time == max_time));
        equal += else_where.query.x == query.x;
      }
      CHECK(equal == 0);
    }
}

// 4096 starts; each share is a binomial one, and the bounds are more than 5 standard deviations away.
TEST_CASE("Varied starts are far, fast, flat, on surfaces and limited as often as is said",
          "[flights][starts]") {
  for (const char* name : {"square", "cubic"}) {
    CAPTURE(name);
    const Shares its = shares_in(all_scenes().at(name), 4096);
    CHECK(its.far > 4096 * 7 / 10);
    CHECK((its.very_far > 256 - 80 && its.very_far < 256 + 80));
    CHECK((its.negative > 1600 && its.negative < 2500));
    CHECK((its.unit_speed > 1024 - 210 && its.unit_speed < 1024 + 150));
    CHECK((its.flat > 256 - 100 && its.flat < 256 + 80));
    CHECK((its.on_surface > 256 - 80 && its.on_surface < 256 + 80));
    CHECK((its.limited > 256 && its.limited < 512 + 100));
    CHECK(its.slowest < 0x1p-9);
    CHECK(its.fastest > 0x1p9);
  }
}

TEST_CASE("Limits of varied starts are near the time of the first hit, and end flights that meet nothing",
          "[flights][starts]") {
  const Scene scene = all_scenes().at("square");
  const oracle::Oracle oracle(scene);
  const VariedStarts starts(scene, kSeed);
  int before = 0, after = 0, endless = 0;
  for (std::uint64_t i = 0; i < 4096; ++i) {
    const auto [query, max_time] = starts[i];
    const Answer exact = oracle.first_hit(query);
    if (exact.outcome == Outcome::never) {
      ++endless;
      REQUIRE(max_time * length(query.v) >= 250 * (1 - 1e-9));
      REQUIRE(max_time * length(query.v) <= 4000);
    } else if (std::isfinite(max_time)) {
      (max_time < *exact.time ? before : after) += 1;
      REQUIRE(max_time >= *exact.time / 4);
      REQUIRE(max_time <= *exact.time * 4);
    }
  }
  CHECK(before > 60);
  CHECK(after > 60);
  CHECK(endless > 60);
}

TEST_CASE("Varied starts stay in the claim's domain, and vary there", "[flights][starts][claim]") {
  Claim claim;
  claim.domain.speed = {0.5, 3}, claim.domain.coordinates = {0, 50}, claim.domain.limits = false;
  const Scene scene = all_scenes().at("cubic");
  const VariedStarts starts(scene, kSeed, claim);
  int moved = 0, faster = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const auto [query, max_time] = starts[i];
    REQUIRE(claim.domain.has(query));
    REQUIRE(std::isinf(max_time));
    moved += farthest(query) > 2, faster += std::fabs(length(query.v) - 1) > 1e-9;
  }
  CHECK(moved > 200);
  CHECK(faster > 50);
  // No start has speed 1 there: each is brought inside.
  claim.domain.speed = {100, 300};
  const VariedStarts fast(scene, kSeed, claim);
  for (std::uint64_t i = 0; i < 100; ++i) REQUIRE(claim.domain.has(fast[i].query));
}

TEST_CASE("Every other varied start is aimed at an obstacle where most of space is empty",
          "[flights][starts]") {
  for (const char* name : {"ball", "two-balls"}) {
    const Scene scene = all_scenes().at(name);
    const oracle::Oracle oracle(scene);
    const VariedStarts starts(scene, kSeed);
    int hits = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const auto [query, max_time] = starts[i];
      const bool hit = oracle.first_hit(query).outcome == Outcome::hit;
      hits += hit;
      CHECK((hit || (max_time > 0 && std::isfinite(max_time))));
    }
    CAPTURE(name, hits);
    CHECK(hits > 400);  // of flights that are not aimed one in twenty meets something
    CHECK(hits < 600);
  }
}
