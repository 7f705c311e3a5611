// Wrong answers that were once given (docs/faults.md), each in its smallest case: `reduction`, `certified`,
// the oracle and `walk` answer it rightly.
#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>

#include <lorentz/certified.hpp>
#include <lorentz/walk.hpp>
#include "tests/engines/reduction_support.hpp"
#include "tests/support/scenes.hpp"

using namespace lorentz;
using test::one_atom;

namespace {

ObstacleId at(std::int64_t a, std::int64_t b, std::int64_t c = 0) {
  return {0, 0, {Integer(a), Integer(b), Integer(c)}};
}

// Everyone who claims to be exact says so; `reduction` may leave it undecided.
void check_all(const Scene& scene, const Query& query, const Answer& expected) {
  INFO(test::stream(scene, query) << test::line(expected, scene.dimension));
  CHECK(test::same(oracle::Oracle(scene).first_hit(query), expected));
  CHECK(test::same(oracle::Certified(scene).first_hit(query), expected));
  const Answer walked = oracle::Walk(scene, 2'000).first_hit(query);
  if (walked.outcome != Outcome::undecided) CHECK(test::same(walked, expected));
  test::Count count;
  if (!Reduction::beyond(scene)) test::check(scene, query, count);
}

}  // namespace

TEST_CASE("Fault: 10^13 cells out a start in a neighbour's ball was taken to be free", "[engines][faults]") {
  const Scene cubic = one_atom(3, {Vec{0.7, 0, 0}, Vec{0, 0.7, 0}, Vec{0, 0, 0.7}}, 0.34929299999999996);
  check_all(
      cubic,
      {{-5914691461647.849, 2.8, -0.7}, {-0.09441574703194348, -0.6028799830594829, -2.794610126792895}, {}},
      Answer::inside(at(-8449559230925, 4, -1)));
}

TEST_CASE("Fault: in a skewed cell `from` was forgotten, 64 bits being too few for it", "[engines][faults]") {
  const Scene skewed = one_atom(2, {Vec{490001, -700}, Vec{-700, 1}}, 0.25);
  check_all(skewed, {{1099511627776.125, 1099511627776}, {1, 0}, at(770757651070976, 539531455261310976)},
            Answer::hit(at(770757651070977, 539531455261311676), 0.625));
  // Coordinates beyond 64 bits.
  const Scene more = one_atom(2, {Vec{0x1p19, 1}, Vec{0x1p38 - 1, 0x1p19}}, 0.25);
  const Query start{{0x1p43 + 0.125, 0x1p43}, {1, 0}, {}};
  const Answer first = oracle::Oracle(more).first_hit(start);
  REQUIRE(first.outcome == Outcome::inside);
  CHECK_FALSE(first.obstacle.cell[0].fits_int64());
  const Query leaving{start.x, start.v, first.obstacle};
  check_all(more, leaving, oracle::Oracle(more).first_hit(leaving));
}

TEST_CASE("Fault: `never` was said where a component that vanishes in other units leads to a hit",
          "[engines][faults]") {
  const Query along{{0, 1}, {1, 0}, {}};
  for (const double tiny : {5e-324, 0x1p-700}) {
    const Scene drifting = one_atom(2, {Vec{2, tiny}, Vec{0, 2}}, 0.5);
    CHECK(oracle::Oracle(drifting).first_hit(along).outcome == Outcome::hit);
    check_all(drifting, along, oracle::Oracle(drifting).first_hit(along));
    const Scene diagonal = one_atom(2, {Vec{1, tiny}, Vec{0, 1}}, 0.25);
    const Query query{{0.5, 0}, {1, 1}, {}};
    CHECK(oracle::Oracle(diagonal).first_hit(query).outcome == Outcome::hit);
    check_all(diagonal, query, oracle::Oracle(diagonal).first_hit(query));
    const Scene spatial = one_atom(3, {Vec{2, 0, tiny}, Vec{0, 2, 0}, Vec{0, 0, 2}}, 0.5);
    const Query in_space{{0, 1, 1}, {1, 0, 0}, {}};
    check_all(spatial, in_space, oracle::Oracle(spatial).first_hit(in_space));
  }
  const Scene large = one_atom(2, {Vec{0x1p399, 0x1p-700}, Vec{0, 0x1p399}}, 0x1p397);
  const Query between{{0, 0x1p398}, {1, 0}, {}};
  CHECK(oracle::Oracle(large).first_hit(between).outcome == Outcome::hit);
  check_all(large, between, oracle::Oracle(large).first_hit(between));
}

TEST_CASE("Fault: a time limit was held against the rounded time", "[engines][faults]") {
  const Scene scene = unit_scene(2, 0.1);
  const Query query{{-0.5, 0}, {1, 0}, {}};
  const oracle::Walk walk(scene);
  REQUIRE(walk.first_hit(query).time == 0.4);  // a binary64 above the exact time
  for (const double limit : {0.3999999999999999, 0.4, 0.4000000000000001, 0.0, -1.0}) {
    INFO("limit " << limit);
    const Answer exact = oracle::Oracle(scene).first_hit(query, {.max_time = limit});
    CHECK(exact.outcome == (limit >= 0.4 ? Outcome::hit : Outcome::later));
    CHECK(test::same(walk.first_hit(query, limit), exact));
    CHECK(test::same(oracle::Certified(scene).first_hit(query, {.max_time = limit}), exact));
  }
  // Nothing before the limit, and nothing at all; a walk that a limit ends early.
  CHECK(walk.first_hit({{0, 0.5}, {1, 0}, {}}, 1e300).outcome == Outcome::later);
  CHECK(oracle::Walk(unit_scene(2, 1e-6), 100).first_hit({{0, 0.5}, {1, 0.37}, {}}, 10).outcome ==
        Outcome::later);
}

TEST_CASE("Fault: a hit just before a time limit was not found, 10^24 cells out", "[engines][faults]") {
  const Scene scene = one_atom(2, {Vec{1, 4}, Vec{-1, 3}}, 0.25);
  const Query query{{0, 1.5}, {1.9777177083685562, 1.0224560545442454e-25}, {}};
  const double time = *oracle::Oracle(scene).first_hit(query).time;
  for (const double limit : {std::nextafter(time, 0), time, std::nextafter(time, 1e300), time * (1 + 0x1p-40),
                             time * (1 + 0x1p-25), 2 * time}) {
    INFO("limit " << limit);
    const Answer exact = oracle::Oracle(scene).first_hit(query, {.max_time = limit});
    CHECK(test::same(oracle::Certified(scene).first_hit(query, {.max_time = limit}), exact));
    const Answer given = make_engine("reduction", scene)->first_hit(query, limit);
    if (given.outcome != Outcome::undecided) CHECK(given.outcome == exact.outcome);
  }
}

TEST_CASE("Fault: a hit after a time limit was said to be at 0, next to the surface of an ellipsoid",
          "[engines][faults]") {
  const double a = 4.172325134277344e-06;
  Scene scene = unit_scene(3, 0);
  scene.lattices[0].atoms = {
      {{2.5033950805664062e-06, 0, 0}, 0, {Vec{0, 0, a}, Vec{a, 0, 0}, Vec{0, 3.0517578125e-05, 0}}}};
  const Query query{{-1.0587911840678754e-22, 0, -3.337860107421875e-06}, {0, 0, 1}, {}};
  const double time = *oracle::Oracle(scene).first_hit(query).time;
  CHECK(time == 7.940933880509066e-23);
  for (const double limit :
       {3.97e-23, time / 2, std::nextafter(time, 0), time, std::nextafter(time, 1), 2 * time}) {
    INFO("limit " << limit);
    const Answer exact = oracle::Oracle(scene).first_hit(query, {.max_time = limit});
    CHECK(test::same(oracle::Certified(scene).first_hit(query, {.max_time = limit}), exact));
    const Answer given = make_engine("reduction", scene)->first_hit(query, limit);
    CHECK((given.outcome == exact.outcome || given.outcome == Outcome::undecided));
  }
  CHECK(make_engine("reduction", scene)->first_hit(query, 3.97e-23).outcome == Outcome::later);
}

TEST_CASE("Fault: a time limit was held against a time that is a few ulps off", "[engines][faults]") {
  const Scene scene = unit_scene(2, 0.1);
  const Query query{{-0.5, 0}, {1, 0}, {}};  // the exact time is a little below 0.4
  for (const double limit : {0.3999999999999999, 0.4, 0.4000000000000001}) {
    INFO("limit " << limit);
    CHECK(make_engine("reduction", scene)->first_hit(query, limit).outcome ==
          (limit >= 0.4 ? Outcome::hit : Outcome::later));
  }
  // A time that is a binary64, as a limit: what is next to it is told apart from it.
  const Scene exact = unit_scene(2, 0.125);
  const auto before = [&](double limit) {
    return make_engine("reduction", exact)->first_hit(query, limit).outcome;
  };
  CHECK(before(0.375) == Outcome::later);
  CHECK(before(std::nextafter(0.375, 0)) == Outcome::later);
  CHECK(before(std::nextafter(0.375, 1)) == Outcome::hit);
  // Nothing is entered before 0.
  CHECK(before(0) == Outcome::later);
  CHECK(before(-1) == Outcome::later);
}

TEST_CASE("Fault: the disc behind a slender ellipse that is grazed was said to be hit first",
          "[engines][faults]") {
  Scene scene = unit_scene(2, 0.01);
  scene.lattices[0].atoms = {
      {{0.2258903839499338, -0.08656848772261432},
       0,
       {Vec{0.18668953797695942, -0.07174270980350146}, Vec{0.00011051321416583061, 0.00028757850030304734}}},
      {{0.33093176339349634, -0.1272081344214228}, 0.01, {}}};
  check_all(
      scene,
      {{-0.00012844915334166043, -0.00033517310201102064}, {0.9337780460670422, -0.3578538931277301}, {}},
      Answer::hit(at(0, 0), 0.34453844508457626));
}

// Nine times as long as wide: its slack errs by so much that the time was 7 ulps off, and 13 with other
// numbers of the kind.
TEST_CASE("Fault: the time at which a slender ellipse is grazed was off by many ulps", "[engines][faults]") {
  Scene scene = one_atom(2, {Vec{1.3870086669921875, 0}, Vec{0.6935028256504958, 1.1953125}}, 0);
  scene.lattices[0].atoms[0].semiaxes = {Vec{-0.0234375, -0.015625}, Vec{0.0009765625, -0.0029296875}};
  const Query query{{0.75, 0.390625}, {-1, 0.375}, {}};
  const double time = 104.1039546892888;
  check_all(scene, query, Answer::hit(at(-91, 33), time));
  const Flight flight = Reduction(scene).fly(query);
  REQUIRE(flight.outcome == Outcome::hit);
  CHECK(std::fabs(flight.time - time) <= std::nextafter(time, 1e300) - time);
}

// The corridor of (p, q) has the width 1 / |(p, q)| - 2 r, here zero but for rounding; the start is midway
// between its edges, so that discs on both sides touch the line, or nearly.
TEST_CASE("Fault: a flight between discs that leave no corridor, but for rounding, did not end",
          "[engines][faults]") {
  check_all(unit_scene(2, 0.22360679774997896), {{0.5, 0}, {1.9375, 0.96875}, {}}, Answer::never());
  test::Count count;
  for (int p = 1; p <= 16; p *= 2)
    for (int q = 1; q <= 9; ++q)
      for (int ulps = -1; ulps <= 1 && std::gcd(p, q) == 1; ++ulps) {
        const double r = 0.5 / std::sqrt(p * p + q * q);
        const Scene square = unit_scene(2, ulps == 0 ? r : std::nextafter(r, ulps));
        for (int speed = 32; speed < 64; ++speed)
          test::check(square, {{0.5 / p, 0}, {q * std::ldexp(speed, -5), p * std::ldexp(speed, -5)}, {}},
                      count);
      }
  CHECK(count.stages.undecided == 0);
  CHECK(count.never > 0);
  CHECK(count.hit > 0);
}
