#include <lorentz/walk.hpp>

#include <catch2/catch.hpp>

#include <lorentz/oracle.hpp>
#include "tests/support/support.hpp"

using namespace lorentz;

TEST_CASE("Walk says undecided where it will not go", "[oracle][walk]") {
  CHECK(oracle::Walk(unit_scene(2, 0.1), 10).first_hit({{0, 0.445}, {0.99985, 0.01745}, {}}).outcome ==
        Outcome::undecided);
  CHECK(oracle::Walk(unit_scene(2, 0.1)).first_hit({{0x1p60, 0.445}, {1, 0.5}, {}}).outcome ==
        Outcome::undecided);
  CHECK(oracle::Walk(unit_scene(2, 1000)).first_hit({{0, 0.445}, {1, 0.5}, {}}).outcome ==
        Outcome::undecided);
}

TEST_CASE("Walk knows a period when it has seen it, also one that `from` hides once", "[oracle][walk]") {
  const oracle::Walk walk(unit_scene(2, 0.25));
  CHECK(walk.first_hit({{0, 0.5}, {1, 0}, {}}).outcome == Outcome::never);
  CHECK(walk.first_hit({{0.5, 0.25}, {1, 1}, {}}).outcome == Outcome::hit);
  const Answer answer =
      walk.first_hit({{0.5, 0}, {1, 0}, ObstacleId{0, 0, {Integer(1), Integer(0), Integer(0)}}});
  CHECK(answer.outcome == Outcome::hit);
  CHECK(answer.obstacle.cell[0] == Integer(2));
}

TEST_CASE("A period in which `from` was the only obstacle is not the last word", "[oracle][walk]") {
  // The line y = (x - 1) / 2 from beyond disc (1, 0): through `from` = (3, 1), then its translate (5, 2).
  const Query query{{1.3, 0.15}, {2, 1}, ObstacleId{0, 0, {Integer(3), Integer(1), Integer(0)}}};
  const Answer answer = oracle::Walk(unit_scene(2, 0.1)).first_hit(query);
  CHECK(answer.outcome == Outcome::hit);
  CHECK(answer.obstacle.cell == Cell{Integer(5), Integer(2), Integer(0)});
}

TEST_CASE("Walk looks as far as obstacles reach", "[oracle][walk]") {
  // Spacing 1/4 along x, radius 1: the disc in the next cell but three is entered first, from a cell that is
  // not its own.
  Scene scene = unit_scene(2, 1);
  scene.lattices[0].vectors = {Vec{0.25, 0}, Vec{0, 8}, Vec{}};
  for (int i = 0; i < 64; ++i) {
    const double slope = 3 * i / 64.0;
    const Query query{{0.01 * i, 2}, {slope, -1}, {}};
    INFO(test::stream(scene, query));
    CHECK(test::same(oracle::Walk(scene).first_hit(query), oracle::Oracle(scene).first_hit(query)));
  }
  CHECK(oracle::Walk(scene).first_hit({{0, 0.999}, {1, 0}, {}}).obstacle.cell[0] == Integer(0));
  CHECK(oracle::Walk(scene).first_hit({{0, 0.5}, {1, 0}, {}}).obstacle.cell[0] == Integer(-3));
}

TEST_CASE("Walk rounds ties to even", "[oracle][walk]") {
  // From inside disc (0, 0), which is `from`, to x = 3/4: 3/4 - m 2^-54 lies midway between two binary64.
  const oracle::Walk walk(unit_scene(2, 0.25));
  CHECK(walk.first_hit({{0x1p-54, 0}, {1, 0}, ObstacleId{}}).time == 0.75);
  CHECK(walk.first_hit({{3 * 0x1p-54, 0}, {1, 0}, ObstacleId{}}).time == 0.75 - 0x1p-52);
}

TEST_CASE("Walk rounds times at the ends of the range", "[oracle][walk]") {
  const oracle::Walk walk(unit_scene(2, 0.25));
  CHECK(walk.first_hit({{0.5, 0}, {0x1p1023, 0}, {}}).time == 0x1p-1025);
  CHECK(walk.first_hit({{0.25, 0}, {-1, 0}, {}}).time == 0.0);
}
