// Flights that no walk can follow. A flight in a lattice plane of the cube is a flight in the square: the 2D
// search (continued fractions) and the 3D one (lattice reduction) share the row solver but not the search, so
// each checks the other at any distance. And a few answers are known in closed form.
#include <catch2/catch.hpp>

#include <lorentz/oracle.hpp>
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

TEST_CASE("2D by continued fractions equals 3D by lattice reduction, at any distance",
          "[engines][long_flight]") {
  Draw draw(21);
  INFO("seed 21");
  int far = 0;
  for (int i = 0; i < 1500; ++i) {
    const double r = std::exp2(draw.between(-45, -1.01));
    const int plane = static_cast<int>(draw.below(3));
    const int a = (plane + 1) % 3, b = (plane + 2) % 3;
    Query flat{draw.vec(2, 0, 1), draw.vec(2, -1, 1), {}};
    if (draw.one_in(2)) flat.v[1] = number(draw, Style::near_grid, 2);
    if (draw.one_in(2)) flat.v[0] = number(draw, Style::near_grid, 2);
    if (flat.v == Vec{}) continue;
    Query solid;
    solid.x[a] = flat.x[0], solid.x[b] = flat.x[1];
    solid.v[a] = flat.v[0], solid.v[b] = flat.v[1];
    const Scene square = unit_scene(2, r), cube = unit_scene(3, r);
    const Answer in_plane = oracle::Oracle(square).first_hit(flat),
                 in_space = oracle::Oracle(cube).first_hit(solid);
    INFO(stream(square, flat) << line(in_plane, 2) << stream(cube, solid) << line(in_space, 3));
    REQUIRE(in_plane.outcome == in_space.outcome);
    REQUIRE(in_plane.time == in_space.time);
    if (in_plane.outcome != Outcome::hit) continue;
    far += *in_plane.time > 1e9;
    REQUIRE(in_space.obstacle.cell[a] == in_plane.obstacle.cell[0]);
    REQUIRE(in_space.obstacle.cell[b] == in_plane.obstacle.cell[1]);
    REQUIRE(in_space.obstacle.cell[plane] == Integer(0));
  }
  CHECK(far > 380);  // 485 seen
}

TEST_CASE("A plane of the cube off the flight's own is a square of smaller discs", "[engines][long_flight]") {
  // At height z over the plane, |z| < r, a sphere of radius r shows a disc of radius sqrt(r^2 - z^2): with
  // (z, r) = (3, 5) and (5, 13) over powers of two that is exact. The times agree as the chords do.
  Draw draw(22);
  INFO("seed 22");
  for (int i = 0; i < 500; ++i) {
    const bool five = draw.one_in(2);
    const int shift = -static_cast<int>(5 + draw.below(30));
    const double z = std::ldexp(five ? 3 : 5, shift), r = std::ldexp(five ? 5 : 13, shift),
                 disc = std::ldexp(five ? 4 : 12, shift);
    const Query flat{draw.vec(2, 0, 1), draw.vec(2, -1, 1), {}};
    Query solid = flat;
    solid.x[2] = z;
    const Answer in_plane = oracle::Oracle(unit_scene(2, disc)).first_hit(flat);
    const Answer in_space = oracle::Oracle(unit_scene(3, r)).first_hit(solid);
    INFO(stream(unit_scene(3, r), solid) << line(in_plane, 2) << line(in_space, 3));
    REQUIRE(same(in_plane, in_space));
  }
}

TEST_CASE("A slow drift out of a corridor: the hit is where the closed form says", "[engines][long_flight]") {
  // v = (1, 2^-k) from (0, 1/2), r: the first disc of the row y = 1 is met once 1/2 + x 2^-k + sqrt(1 + 4^-k)
  // r > 1.
  for (int k = 4; k <= 200; k += 4) {
    const double r = 0.25, drift = std::ldexp(1, -k);
    const Answer answer = oracle::Oracle(unit_scene(2, r)).first_hit({{0, 0.5}, {1, drift}, {}});
    REQUIRE(answer.outcome == Outcome::hit);
    REQUIRE(answer.obstacle.cell[1] == Integer(1));
    // n 2^-k > 1/4 - (sqrt(1 + 4^-k) - 1) / 4: the bracket is below 4^-k / 8, so for k >= 4 n = 2^(k-2) is
    // the first.
    const double power = std::ldexp(1, k - 2);
    if (k - 2 <= 62)
      REQUIRE(answer.obstacle.cell[0] == Integer(static_cast<std::int64_t>(power)));
    else
      REQUIRE_FALSE(answer.obstacle.cell[0].fits_int64());
    REQUIRE(std::fabs(*answer.time - power) <=
            std::max(drift, power * 0x1p-52));  // nearly grazed: entered at the closest point
  }
}

TEST_CASE("The plane channels of the cube: a drift of 2^-k across the channel", "[engines][long_flight]") {
  for (int k = 10; k <= 300; k += 10) {
    for (const double v_x : {1.0, 0.53}) {
      const Answer answer =
          oracle::Oracle(unit_scene(3, 0.1)).first_hit({{0, 0, 0.5}, {v_x, 0.618, std::ldexp(1, -k)}, {}});
      REQUIRE(answer.outcome == Outcome::hit);
      REQUIRE(answer.obstacle.cell[2] == Integer(1));
      // The channel is left at z = 0.9; the plane z = 1 cannot be passed without a hit of something near z
      // = 1.
      REQUIRE(*answer.time * std::ldexp(1, -k) > 0.4 * (1 - 1e-12));
      REQUIRE(*answer.time * std::ldexp(1, -k) < 0.6);
    }
  }
}

TEST_CASE("Within a channel, however long its period: never", "[engines][long_flight]") {
  const auto outcome = [](int dimension, double r, Vec x, Vec v) {
    return oracle::Oracle(unit_scene(dimension, r)).first_hit({x, v, {}}).outcome;
  };
  CHECK(outcome(3, 0.1, {0, 0, 0.5}, {1, 0.618, 0}) == Outcome::never);
  CHECK(outcome(3, 0.1, {0, 0, 0.1}, {1, 0.618, 0}) == Outcome::never);
  CHECK(outcome(3, 0.1, {0.5, 0.5, std::nextafter(0.1, 0)}, {1, 0.618, 0}) == Outcome::hit);
  CHECK(outcome(3, 0.499, {0.5, 0.5, 0.3}, {0, 0, 1e-300}) == Outcome::never);
  CHECK(outcome(3, 0.2, {0.5, 0, 0}, {1, 1, 0}) == Outcome::never);
  CHECK(outcome(3, 0.36, {0.5, 0, 0}, {1, 1, 0}) == Outcome::hit);
  CHECK(outcome(2, 0.25, {0, 0.5}, {1, 0}) == Outcome::never);
  CHECK(outcome(2, 0.5, {0, 0.5}, {1, 0}) == Outcome::never);  // tangent to every disc on both sides
  CHECK(outcome(2, std::nextafter(0.5, 1), {0, 0.5}, {1, 0}) == Outcome::inside);
  CHECK(outcome(2, 1e-12, {0, 0.3}, {3, 4}) == Outcome::never);
}

TEST_CASE("Cells beyond 2^63, and starts there", "[engines][long_flight]") {
  const oracle::Oracle oracle(unit_scene(2, 0.25));
  const Answer far = oracle.first_hit({{0x1p80, 0.5}, {1, 0x1p-20}, {}});
  REQUIRE(far.outcome == Outcome::hit);
  REQUIRE(far.obstacle.cell[0] == *Integer::from_decimal("1208925819614629174968320"));  // 2^80 + 2^18
  const Answer near = oracle.first_hit({{0, 0.5}, {1, 0x1p-20}, {}});
  REQUIRE(near.obstacle.cell[0] == Integer(1 << 18));
  REQUIRE(far.time == near.time);
  // Beyond the largest binary64 the time is infinite, and the obstacle still exact.
  const Answer beyond = oracle.first_hit({{0, 0.5}, {0x1p-1000, 0x1p-1070}, {}});
  REQUIRE(beyond.outcome == Outcome::hit);
  REQUIRE(std::isinf(*beyond.time));
  REQUIRE(beyond.obstacle.cell[0] == *Integer::from_decimal("295147905179352825856"));  // 2^68
}
