// The constructed queries of `lorentz bench`: repeatable, and as near to the edge as they claim.
#include "compare/hard_cases.hpp"

#include <catch2/catch.hpp>

#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::compare;

TEST_CASE("Hard queries depend on the seed only, and are free starts", "[compare][hard_cases]") {
  for (const int dimension : {2, 3}) {
    const Scene scene = unit_scene(dimension, 0.2);
    const oracle::Oracle oracle(scene);
    for (const Difficulty difficulty : {Difficulty::drawn, Difficulty::near_rational, Difficulty::grazing}) {
      const auto queries = hard_queries(difficulty, scene, oracle, 5, 200);
      const auto more = hard_queries(difficulty, scene, oracle, 5, 300);
      REQUIRE(queries.size() == 200);
      for (std::size_t i = 0; i < queries.size(); ++i) {
        CHECK(queries[i].x == more[i].x);
        CHECK(queries[i].v == more[i].v);
        CHECK(oracle.is_free(queries[i].x));
      }
    }
  }
}

TEST_CASE("Grazing queries pass a ball near its edge: a radius changed by 2^-9 changes what is hit",
          "[compare][hard_cases]") {
  const Scene scene = unit_scene(2, 0.2), smaller = unit_scene(2, 0.2 * (1 - 0x1p-9)),
              larger = unit_scene(2, 0.2 * (1 + 0x1p-9));
  const oracle::Oracle oracle(scene);
  long changed = 0;
  for (const Query& query : hard_queries(Difficulty::grazing, scene, oracle, 6, 300)) {
    const Answer a = oracle::Oracle(smaller).first_hit(query), b = oracle::Oracle(larger).first_hit(query);
    changed += !(a.obstacle == b.obstacle);
  }
  CHECK(changed > 200);  // 236 seen
  long by_chance = 0;
  for (const Query& query : hard_queries(Difficulty::drawn, scene, oracle, 6, 300)) {
    const Answer a = oracle::Oracle(smaller).first_hit(query), b = oracle::Oracle(larger).first_hit(query);
    by_chance += !(a.obstacle == b.obstacle);
  }
  CHECK(by_chance < 30);  // 6 seen
}

TEST_CASE("Grazing queries pass ellipsoids near their edge", "[compare][hard_cases]") {
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
    const oracle::Oracle oracle(scene), smaller(scaled(1 - 0x1p-9)), larger(scaled(1 + 0x1p-9));
    long changed = 0;
    for (const Query& query : hard_queries(Difficulty::grazing, scene, oracle, 7, 300))
      changed += !(smaller.first_hit(query).obstacle == larger.first_hit(query).obstacle);
    CHECK(changed > 200);  // 238 seen at least
  }
}
