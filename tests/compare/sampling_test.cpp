#include "compare/sampling.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include <lorentz/exchange.hpp>
#include "cases/random.hpp"

using namespace lorentz;
using namespace lorentz::compare;

TEST_CASE("Drawn queries depend on seed and index only", "[compare][sampling]") {
  const Scene scene = unit_scene(3, 0.3);
  const oracle::Oracle oracle(scene);
  const auto few = draw_queries(scene, oracle, 5, 10), many = draw_queries(scene, oracle, 5, 100),
             other = draw_queries(scene, oracle, 6, 10);
  for (int i = 0; i < 10; ++i) {
    CHECK(few[i].x == many[i].x);
    CHECK(few[i].v == many[i].v);
    CHECK_FALSE(few[i].x == other[i].x);
  }
}

TEST_CASE("Drawn starts are free and fill the cell evenly, directions are isotropic", "[compare][sampling]") {
  for (const int dimension : {2, 3}) {
    const Scene scene = unit_scene(dimension, 0.3);
    const oracle::Oracle oracle(scene);
    constexpr int kCount = 20000;
    Vec mean_x{}, mean_v{}, mean_v2{};
    for (const Query& query : draw_queries(scene, oracle, kDefaultSeed, kCount)) {
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

TEST_CASE("No direction is preferred: 16 sectors of the circle hold as many each", "[compare][sampling]") {
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

TEST_CASE("A scene without free part is refused", "[compare][sampling]") {
  const Scene scene = unit_scene(2, 0.8);
  CHECK_THROWS_AS(draw_queries(scene, oracle::Oracle(scene), 1, 1), InputError);
}

TEST_CASE("A superposition is drawn from a box of 1000 cells", "[compare][sampling]") {
  Scene scene = unit_scene(2, 0.1);
  scene.lattices.push_back(scene.lattices[0]);
  scene.lattices[1].vectors = {Vec{0.8, 0.6}, Vec{-0.6, 0.8}};
  double widest = 0;
  for (const Query& query : draw_queries(scene, oracle::Oracle(scene), 1, 1000))
    widest = std::max(widest, query.x[0]);
  CHECK(widest > 35);  // 39.9 seen, of 40
  CHECK(widest < 40);
}
