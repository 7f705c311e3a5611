#include "src/engines/classical/classical.hpp"

#include <catch2/catch.hpp>

#include <lorentz/oracle.hpp>
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

TEST_CASE("Classical is right on ordinary flights, its time nearly so", "[engines][classical]") {
  Draw draw(71);
  INFO("seed 71");
  double worst = 0;
  for (int i = 0; i < 4000; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Scene scene = unit_scene(dimension, draw.between(0.05, 0.45));
    const auto engine = make_engine("classical", scene);
    const Query query{draw.vec(dimension, -2, 2), draw.vec(dimension, -1, 1), {}};
    const Answer exact = oracle::Oracle(scene).first_hit(query), given = engine->first_hit(query);
    INFO(stream(scene, query) << line(exact, dimension) << line(given, dimension));
    REQUIRE(same_obstacle(exact, given));
    if (given.outcome == Outcome::hit)
      worst = std::max(worst, std::fabs(*given.time - *exact.time) / *exact.time);
  }
  CHECK(worst < 1e-8);
}

TEST_CASE("Classical says undecided at its cap, later at a time limit, unsupported where it cannot",
          "[engines][classical]") {
  const auto engine = make_engine("classical", unit_scene(2, 0.1));
  CHECK(engine->first_hit({{0, 0.5}, {1, 0}, {}}).outcome == Outcome::undecided);
  CHECK(engine->first_hit({{0, 0.5}, {1, 0}, {}}, 100).outcome == Outcome::later);
  CHECK(engine->first_hit({{0.5, 0}, {1, 0}, {}}, 100).outcome == Outcome::hit);
  CHECK(engine->first_hit({{0.5, 0}, {1, 0}, {}}, 0.3).outcome == Outcome::later);
  CHECK(engine->first_hit({{0x1p60, 0}, {1, 0}, {}}).unsupported);
  CHECK(make_engine("no such engine", unit_scene(2, 0.1)) == nullptr);
}

TEST_CASE("Classical leaves the disc it starts from", "[engines][classical]") {
  const auto engine = make_engine("classical", unit_scene(2, 0.25));
  const Answer answer = engine->first_hit({{0.25, 0}, {1, 0}, ObstacleId{}});
  CHECK(answer.obstacle.cell[0] == Integer(1));
  CHECK(answer.time == 0.5);
  CHECK(engine->first_hit({{0.1, 0}, {1, 0}, {}}).outcome == Outcome::inside);
}

TEST_CASE("An obstacle named as left is never hit, however far off", "[engines][classical]") {
  const Query reported{{0, 0.8125}, {0.625, 1.5}, ObstacleId{0, 0, {3, 8, 0}}};
  CHECK(make_engine("classical", unit_scene(2, 0.0625))->first_hit(reported).obstacle.cell == Cell{8, 20, 0});
  CHECK(make_engine("published", unit_scene(2, 0.0625))->first_hit(reported).obstacle.cell == Cell{8, 20, 0});
  Draw draw(72);
  INFO("seed 72");
  for (int i = 0; i < 2000; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Scene scene = unit_scene(dimension, draw.between(0.1, 0.45));
    const oracle::Oracle oracle(scene);
    Query query{draw.vec(dimension, -2, 2), draw.vec(dimension, -1, 1), {}};
    const Answer first = oracle.first_hit(query);
    if (first.outcome != Outcome::hit) continue;
    query.from = first.obstacle;
    const Answer exact = oracle.first_hit(query), given = make_engine("classical", scene)->first_hit(query);
    INFO(stream(scene, query) << line(exact, dimension) << line(given, dimension));
    REQUIRE(same_obstacle(exact, given));
    const Answer published = make_engine("published", scene)->first_hit(query);
    REQUIRE_FALSE((published.outcome == Outcome::hit && published.obstacle == *query.from));
  }
}

TEST_CASE("The velocity's length goes into the time only", "[engines][classical]") {
  for (const char* name : {"classical", "published"}) {
    const auto engine = make_engine(name, unit_scene(2, 0.1));
    const Answer unit = engine->first_hit({{0.3, 0.4}, {0.8, 0.6}, {}});
    const Answer tiny = engine->first_hit({{0.3, 0.4}, {std::ldexp(0.8, -1000), std::ldexp(0.6, -1000)}, {}});
    const Answer huge = engine->first_hit({{0.3, 0.4}, {std::ldexp(0.8, 1000), std::ldexp(0.6, 1000)}, {}});
    INFO(name);
    REQUIRE(unit.outcome == Outcome::hit);
    CHECK(tiny.obstacle == unit.obstacle);
    CHECK(huge.obstacle == unit.obstacle);
    CHECK(*tiny.time == std::ldexp(*unit.time, 1000));
    CHECK(*huge.time == std::ldexp(*unit.time, -1000));
  }
}
