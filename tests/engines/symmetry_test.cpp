// What must not change an answer, or change it in a known way. No second implementation is needed for these.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>

#include <lorentz/geometry.hpp>
#include <lorentz/oracle.hpp>
#include "src/problem/scene_geometry.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

// A signed permutation of the axes.
struct Symmetry {
  std::array<int, 3> axis;
  std::array<int, 3> sign;

  Vec operator()(const Vec& a) const {
    Vec b{};
    for (int i = 0; i < 3; ++i) b[i] = sign[i] * a[axis[i]];
    return b;
  }
  Cell operator()(const Cell& a) const {
    Cell b;
    for (int i = 0; i < 3; ++i) b[i] = Integer(sign[i] * a[axis[i]].int64());
    return b;
  }
};

std::vector<Symmetry> symmetries(int dimension) {
  std::vector<Symmetry> all;
  std::array<int, 3> axis{0, 1, 2};
  do {
    if (dimension == 2 && axis[2] != 2) continue;
    for (int signs = 0; signs < (1 << dimension); ++signs)
      all.push_back({axis, {signs & 1 ? -1 : 1, signs & 2 ? -1 : 1, signs & 4 ? -1 : 1}});
  } while (std::next_permutation(axis.begin(), axis.end()));
  return all;
}

}  // namespace

TEST_CASE("The square and the cube look the same from all their sides", "[engines][symmetry]") {
  Draw draw(11);
  INFO("seed 11");
  for (const int dimension : {2, 3}) {
    REQUIRE(symmetries(dimension).size() == (dimension == 2 ? 8u : 48u));
    for (int i = 0; i < 60; ++i) {
      const double r = std::exp2(draw.between(dimension == 2 ? -20 : -10, -1.1));
      const Scene scene = unit_scene(dimension, r);
      const oracle::Oracle oracle(scene);
      const Query query{draw.vec(dimension, 0, 1), draw.vec(dimension, -1, 1), {}};
      const Answer answer = oracle.first_hit(query);
      for (const Symmetry& turn : symmetries(dimension)) {
        const Answer turned = oracle.first_hit({turn(query.x), turn(query.v), {}});
        INFO(stream(scene, query));
        REQUIRE(turned.outcome == answer.outcome);
        REQUIRE(turned.time == answer.time);
        if (answer.outcome == Outcome::hit || answer.outcome == Outcome::inside)
          REQUIRE(turned.obstacle.cell == turn(answer.obstacle.cell));
      }
    }
  }
}

TEST_CASE("Translation by a lattice vector moves the cell and nothing else", "[engines][symmetry]") {
  Draw draw(12);
  INFO("seed 12");
  for (int i = 0; i < 400; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    // Grid numbers keep x + M m exact in binary64.
    Scene scene = scene_of(draw, Style::grid, dimension);
    scene.lattices.resize(1);
    Query query = query_of(draw, Style::grid, scene);
    query.x = vec_of(draw, Style::grid, dimension, 1);
    const oracle::Oracle oracle(scene);
    const Answer answer = oracle.first_hit(query);
    std::array<std::int64_t, 3> m{};
    Query moved = query;
    for (int k = 0; k < dimension; ++k) {
      m[k] = static_cast<std::int64_t>(draw.below(1u << 30)) - (1 << 29);
      for (int c = 0; c < dimension; ++c)
        moved.x[c] += static_cast<double>(m[k]) * scene.lattices[0].vectors[k][c];
    }
    const auto translated = [&](const Cell& cell) {
      Cell result;
      for (int k = 0; k < dimension; ++k) result[k] = Integer(cell[k].int64() + m[k]);
      return result;
    };
    if (moved.from) moved.from->cell = translated(moved.from->cell);
    const Answer there = oracle.first_hit(moved);
    INFO(stream(scene, query) << stream(scene, moved));
    REQUIRE(there.outcome == answer.outcome);
    REQUIRE(there.time == answer.time);
    if (answer.outcome == Outcome::hit || answer.outcome == Outcome::inside) {
      REQUIRE(there.obstacle.atom == answer.obstacle.atom);
      REQUIRE(there.obstacle.cell == translated(answer.obstacle.cell));
    }
  }
}

TEST_CASE("Scaling lengths and velocities by powers of two scales the time, exactly", "[engines][symmetry]") {
  Draw draw(13);
  INFO("seed 13");
  for (int i = 0; i < 400; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Style style = draw.one_in(2) ? Style::generic : Style::near_grid;
    const Scene scene = scene_of(draw, style, dimension);
    const Query query = query_of(draw, style, scene);
    const Answer answer = oracle::Oracle(scene).first_hit(query);
    // Far enough to leave the range in which squares are binary64 numbers; near enough to keep all digits.
    const int length = static_cast<int>(draw.below(1800)) - 900,
              speed = static_cast<int>(draw.below(1800)) - 900;
    if (std::abs(length - speed) > 900) continue;
    const Query large{times_power_of_two(query.x, length), times_power_of_two(query.v, speed), query.from};
    const Answer other = oracle::Oracle(scaled(scene, length)).first_hit(large);
    INFO(stream(scene, query) << "lengths 2^" << length << ", velocities 2^" << speed);
    REQUIRE(other.outcome == answer.outcome);
    if (answer.outcome == Outcome::hit) REQUIRE(other.time == std::ldexp(*answer.time, length - speed));
    if (answer.outcome == Outcome::hit || answer.outcome == Outcome::inside)
      REQUIRE(other.obstacle == answer.obstacle);
  }
}

TEST_CASE("Time reversal: the way back from a collision meets nothing before the start",
          "[engines][symmetry]") {
  // Fly from the free point x to the obstacle hit at t; then fly back from (a binary64 near) the collision
  // point. If the way back meets an obstacle before x, the way there would have met it first.
  Draw draw(14);
  INFO("seed 14");
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Scene scene = unit_scene(dimension, std::exp2(draw.between(dimension == 2 ? -12 : -7, -1.1)));
    const oracle::Oracle oracle(scene);
    const Query query{draw.vec(dimension, 0, 1), draw.vec(dimension, -1, 1), {}};
    oracle::Request request;
    request.detail = true;
    const Answer there = oracle.first_hit(query, request);
    if (there.outcome != Outcome::hit || *there.time < 1e-3) continue;
    Query back = reversed(query);
    back.x = there.detail->point;
    back.from = there.obstacle;
    const Answer home = oracle.first_hit(back);
    INFO(stream(scene, query) << stream(scene, back) << line(home, dimension));
    if (home.outcome == Outcome::hit)
      REQUIRE(*home.time > *there.time * (1 - 1e-9));
    else
      REQUIRE(home.outcome == Outcome::never);
    ++compared;
  }
  CHECK(compared > 200);  // 380 seen
}
