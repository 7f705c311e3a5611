// Drawn starts as their users take them: where they lie, where they go, how hard they are. Seeds are fixed.
#include "question/starts/free_starts.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include <lorentz/exchange.hpp>
#include <lorentz/oracle.hpp>
#include "question/cases/random.hpp"

using namespace lorentz;
using namespace lorentz::starts;

TEST_CASE("Starts depend on seed, kind and index only, and are free", "[flights][sample]") {
  for (const int dimension : {2, 3}) {
    const Scene scene = unit_scene(dimension, 0.2);
    const oracle::Oracle oracle(scene);
    for (const Kind kind : {Kind::uniform, Kind::near_rational, Kind::grazing}) {
      const auto few = free_starts(scene, kind, 5, 200), more = free_starts(scene, kind, 5, 300),
                 other = free_starts(scene, kind, 6, 200);
      const FreeStarts later(scene, kind, 5);
      REQUIRE(few.size() == 200);
      for (std::size_t i = 0; i < few.size(); ++i) {
        CHECK(few[i].x == more[i].x);
        CHECK(few[i].v == more[i].v);
        if (i >= 100) CHECK(few[i].x == later[i].x);
        CHECK_FALSE(few[i].x == other[i].x);
        CHECK(oracle.is_free(few[i].x));
      }
    }
  }
}

TEST_CASE("Drawn starts are free and fill the cell evenly, directions are isotropic", "[flights][sample]") {
  for (const int dimension : {2, 3}) {
    const Scene scene = unit_scene(dimension, 0.3);
    const oracle::Oracle oracle(scene);
    constexpr int kCount = 20000;
    Vec mean_x{}, mean_v{}, mean_v2{};
    for (const Query& query : free_starts(scene, Kind::uniform, kDefaultSeed, kCount)) {
      REQUIRE(oracle.is_free(query.x));
      double length2 = 0;
      for (int k = 0; k < dimension; ++k) {
        REQUIRE(query.x[k] >= 0);
        REQUIRE(query.x[k] < 1);
        mean_x[k] += query.x[k] / kCount;
        mean_v[k] += query.v[k] / kCount;
        mean_v2[k] += query.v[k] * query.v[k] / kCount;
        length2 += query.v[k] * query.v[k];
      }
      REQUIRE(length2 == Approx(1).epsilon(1e-15));
    }
    for (int k = 0; k < dimension; ++k) {
      CHECK(mean_x[k] == Approx(0.5).margin(0.01));
      CHECK(mean_v[k] == Approx(0).margin(0.025));
      CHECK(mean_v2[k] == Approx(1.0 / dimension).margin(0.015));
    }
  }
}

TEST_CASE("No direction is preferred: 16 sectors of the circle hold as many each", "[flights][sample]") {
  constexpr int kCount = 32000, kSectors = 16;
  int sectors[kSectors] = {};
  for (int index = 0; index < kCount; ++index) {
    const Vec v = cases::Random(kDefaultSeed, "sectors", static_cast<std::uint64_t>(index)).direction(2);
    const double turn = std::atan2(v[1], v[0]) / (2 * std::numbers::pi);
    ++sectors[static_cast<int>(kSectors * (turn + 1)) % kSectors];
  }
  // 2000 each, standard deviation 43.
  for (const int count : sectors) CHECK(std::abs(count - kCount / kSectors) < 4 * 43);
}

TEST_CASE("A superposition is drawn from a box of 1000 cells", "[flights][sample]") {
  Scene scene = unit_scene(2, 0.1);
  scene.lattices.push_back(scene.lattices[0]);
  scene.lattices[1].vectors = {Vec{0.8, 0.6}, Vec{-0.6, 0.8}};
  double widest = 0;
  for (const Query& query : free_starts(scene, Kind::uniform, 1, 1000)) widest = std::max(widest, query.x[0]);
  CHECK(widest > 35);  // 39.9 seen, of 40
  CHECK(widest < 40);
}

TEST_CASE("Grazing starts pass a ball near its edge: a radius changed by 2^-9 changes what is hit",
          "[flights][sample]") {
  const Scene scene = unit_scene(2, 0.2), smaller = unit_scene(2, 0.2 * (1 - 0x1p-9)),
              larger = unit_scene(2, 0.2 * (1 + 0x1p-9));
  long changed = 0;
  for (const Query& query : free_starts(scene, Kind::grazing, 6, 300)) {
    const Answer a = oracle::Oracle(smaller).first_hit(query), b = oracle::Oracle(larger).first_hit(query);
    changed += !(a.obstacle == b.obstacle);
  }
  CHECK(changed > 200);  // 236 seen
  long by_chance = 0;
  for (const Query& query : free_starts(scene, Kind::uniform, 6, 300)) {
    const Answer a = oracle::Oracle(smaller).first_hit(query), b = oracle::Oracle(larger).first_hit(query);
    by_chance += !(a.obstacle == b.obstacle);
  }
  CHECK(by_chance < 30);  // 6 seen
}

TEST_CASE("Grazing starts pass ellipsoids near their edge", "[flights][sample]") {
  for (const int dimension : {2, 3}) {
    Scene scene = unit_scene(dimension, 1);
    std::vector<Vec>& axes = scene.lattices[0].atoms[0].semiaxes;
    axes = {Vec{0.3, 0.1}, Vec{-0.05, 0.15}};
    if (dimension == 3) axes = {Vec{0.3, 0.1, 0}, Vec{-0.05, 0.15, 0.1}, Vec{0, 0.1, 0.2}};
    const auto scaled = [&](double factor) {
      Scene other = scene;
      for (Vec& axis : other.lattices[0].atoms[0].semiaxes)
        for (double& component : axis) component *= factor;
      return other;
    };
    const oracle::Oracle smaller(scaled(1 - 0x1p-9)), larger(scaled(1 + 0x1p-9));
    long changed = 0;
    for (const Query& query : free_starts(scene, Kind::grazing, 7, 300))
      changed += !(smaller.first_hit(query).obstacle == larger.first_hit(query).obstacle);
    CHECK(changed > 200);  // 238 seen at least
  }
}
