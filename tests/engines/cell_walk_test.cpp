// Classical beyond the unit lattices: against the oracle, and ellipsoids against the balls behind them.
#include "src/engines/classical/cell_walk.hpp"

#include <catch2/catch.hpp>

#include <lorentz/geometry.hpp>
#include <lorentz/oracle.hpp>
#include "src/engines/classical/classical.hpp"
#include "src/problem/scene_geometry.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

Lattice lattice_of_vectors(std::array<Vec, 3> vectors, double radius) {
  return {vectors, {Atom{{}, radius, {}}}};
}

Lattice hexagonal(double r) {
  return lattice_of_vectors({Vec{1, 0}, Vec{0.5, std::sqrt(0.75)}}, r);
}

Lattice fcc(double r) {
  return lattice_of_vectors({Vec{0, 0.5, 0.5}, Vec{0.5, 0, 0.5}, Vec{0.5, 0.5, 0}}, r);
}

Scene scene_with(int dimension, std::vector<Lattice> lattices) {
  return {dimension, std::move(lattices)};
}

// Triclinic cells, motifs of up to three balls (they may overlap), two lattices in one scene of five; or
// hexagonal, or fcc.
Scene drawn_scene(Draw& draw, int dimension) {
  if (draw.one_in(4))
    return scene_with(dimension,
                      {dimension == 2 ? hexagonal(draw.between(0.02, 0.7)) : fcc(draw.between(0.05, 0.6))});
  return scene_of(draw, Style::generic, dimension);
}

// Scene and query after a -> columns a.
Vec mapped(const std::array<Vec, 3>& columns, const Vec& a) {
  Vec sum{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) sum[k] += a[i] * columns[i][k];
  return sum;
}

// Every ball becomes an ellipsoid of the same cell, entered at the same time.
Scene mapped(const std::array<Vec, 3>& columns, Scene scene) {
  for (Lattice& lattice : scene.lattices) {
    for (Vec& vector : lattice.vectors) vector = mapped(columns, vector);
    for (Atom& atom : lattice.atoms) {
      for (int i = 0; i < scene.dimension; ++i) {
        atom.semiaxes.push_back(columns[i]);
        for (double& component : atom.semiaxes[i]) component *= atom.radius;
      }
      atom.position = mapped(columns, atom.position);
      atom.radius = 0;
    }
  }
  return scene;
}

struct Counts {
  int hit = 0, inside = 0, never = 0, wrong = 0;
  double worst = 0;

  void add(const Answer& expected, const Answer& given) {
    hit += expected.outcome == Outcome::hit;
    inside += expected.outcome == Outcome::inside;
    never += expected.outcome == Outcome::never;
    if (expected.outcome != given.outcome || !(expected.obstacle == given.obstacle)) {
      ++wrong;
      UNSCOPED_INFO(line(expected, 3) << line(given, 3));
    } else if (expected.outcome == Outcome::hit) {
      worst = std::max(worst, std::fabs(*given.time - *expected.time) / std::max(1.0, *expected.time));
    }
  }
};

}  // namespace

TEST_CASE("Classical equals the oracle in any cell, with any motif, in superpositions, through overlaps",
          "[engines][cell_walk]") {
  // Generic numbers, flights of up to about 1e4 cells: an entry that rounding errors of 1e-13 decide is met
  // once in about 1e12 queries. So none may differ.
  for (const int dimension : {2, 3}) {
    Draw draw(1400 + static_cast<std::uint64_t>(dimension));
    INFO("seed 140" << dimension);
    Counts counts;
    for (int i = 0; i < 3000; ++i) {
      const Scene scene = drawn_scene(draw, dimension);
      Query query{draw.vec(dimension, -2, 2), draw.vec(dimension, -1, 1), {}};
      if (draw.one_in(3)) query.from = obstacle_of(draw, scene);
      const Answer given = CellWalk(scene).first_hit(query);
      INFO(stream(scene, query) << line(given, dimension));
      const Answer exact = oracle::Oracle(scene).first_hit(query);
      INFO(line(exact, dimension));
      counts.add(exact, given);
      REQUIRE(counts.wrong == 0);
    }
    CHECK(counts.hit > 1000);     // 1 259 seen at least
    CHECK(counts.inside > 1000);  // 1 348 seen at least
    CHECK(counts.worst < 1e-9);
  }
}

TEST_CASE("Classical names the first one among obstacles that are entered at once", "[engines][cell_walk]") {
  Lattice twice = hexagonal(0.25);
  twice.atoms.push_back(twice.atoms[0]);
  const Answer answer = CellWalk(scene_with(2, {twice, twice})).first_hit({{0.5, 0, 0}, {1, 0, 0}, {}});
  CHECK(answer.outcome == Outcome::hit);
  CHECK(answer.obstacle == ObstacleId{0, 0, {1, 0, 0}});
}

TEST_CASE("Classical through cells that are much smaller than the obstacles, and through skewed ones",
          "[engines][cell_walk]") {
  Draw draw(1404);
  INFO("seed 1404");
  Counts counts;
  for (int i = 0; i < 1500; ++i) {
    Lattice lattice = lattice_of_vectors({Vec{1, 0}, Vec{draw.between(-6, 6), draw.between(0.2, 1)}},
                                         draw.between(0.01, 0.08));
    if (draw.one_in(3)) lattice.atoms.push_back({draw.vec(2, -9, 9), draw.between(0.01, 0.3), {}});
    Scene scene = scene_with(2, {lattice});
    if (draw.one_in(3)) scene.lattices.push_back(lattice_of_vectors({Vec{7, 1}, Vec{-1, 8}}, 3));
    const Query query{draw.vec(2, -20, 20), draw.vec(2, -1, 1), {}};
    INFO(stream(scene, query));
    counts.add(oracle::Oracle(scene).first_hit(query), make_engine("classical", scene)->first_hit(query));
    REQUIRE(counts.wrong == 0);
  }
  CHECK(counts.hit > 950);     // 1 190 seen
  CHECK(counts.inside > 240);  // 310 seen
  CHECK(counts.worst < 1e-9);
}

TEST_CASE("An obstacle that begins at a cell's wall is met, on this side of it or on that",
          "[engines][cell_walk]") {
  Draw draw(1405);
  INFO("seed 1405");
  Counts counts;
  for (int i = 0; i < 3000; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    Scene scene = unit_scene(dimension, 0.1);
    Lattice& lattice = scene.lattices[0];
    if (draw.one_in(2)) do
        for (int k = 0; k < dimension; ++k) lattice.vectors[k] = draw.vec(dimension, -1.5, 1.5);
      while (std::fabs(determinant(lattice, dimension)) < 0.3);
    Vec y = draw.vec(dimension, -0.5, 0.5), v = draw.vec(dimension, -1, 1);
    y[0] = 0.5;
    const Vec wall = mapped(lattice.vectors, y);
    const double speed = std::sqrt(dot(v, v));
    Query query{wall, v, {}};
    for (int k = 0; k < dimension; ++k) {  // head on, from up to some cells away
      lattice.atoms[0].position[k] = wall[k] + 0.1 * v[k] / speed;
      query.x[k] -= v[k] * static_cast<double>(i % 3);
    }
    INFO(stream(scene, query));
    const Answer exact = oracle::Oracle(scene).first_hit(query);
    if (exact.outcome == Outcome::inside || *exact.time < 1e-9) continue;  // on which side is rounding's
    counts.add(exact, CellWalk(scene).first_hit(query));
    REQUIRE(counts.wrong == 0);
  }
  CHECK(counts.hit > 1500);  // 1 952 seen
}

TEST_CASE("An ellipsoid is entered when the ball behind it is", "[engines][cell_walk]") {
  for (const int dimension : {2, 3}) {
    Draw draw(1410 + static_cast<std::uint64_t>(dimension));
    INFO("seed 141" << dimension);
    Counts counts;
    for (int i = 0; i < 1500; ++i) {
      const Scene balls = drawn_scene(draw, dimension);
      Lattice map;
      do
        for (int k = 0; k < dimension; ++k) map.vectors[k] = draw.vec(dimension, -1, 1);
      while (std::fabs(determinant(map, dimension)) < 0.1);
      const Scene ellipsoids = mapped(map.vectors, balls);
      Query query{draw.vec(dimension, -2, 2), draw.vec(dimension, -1, 1), {}};
      if (draw.one_in(3)) query.from = obstacle_of(draw, balls);
      const Query image{mapped(map.vectors, query.x), mapped(map.vectors, query.v), query.from};
      INFO(stream(balls, query) << stream(ellipsoids, image));
      counts.add(oracle::Oracle(balls).first_hit(query),
                 make_engine("classical", ellipsoids)->first_hit(image));
      REQUIRE(counts.wrong == 0);  // generic: as for balls
    }
    CHECK(counts.hit > 500);     // 687 seen at least
    CHECK(counts.inside > 540);  // 684 seen at least
    CHECK(counts.worst < 1e-9);
  }
}

TEST_CASE("The general walker equals the unit lattices' own path there", "[engines][cell_walk]") {
  Draw draw(1420);
  INFO("seed 1420");
  Counts counts;
  for (int s = 0; s < 100; ++s) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Scene scene = unit_scene(dimension, draw.between(0.05, 0.5));
    const Classical unit(scene);
    const CellWalk general(scene);
    for (int i = 0; i < 100; ++i) {
      const Query query{draw.vec(dimension, -2, 2), draw.vec(dimension, -1, 1), {}};
      INFO(stream(scene, query));
      const Answer expected = unit.first_hit(query);
      // The dispatch leaves these scenes to their own path, to the bit.
      REQUIRE(same(make_engine("classical", scene)->first_hit(query), expected));
      counts.add(expected, general.first_hit(query));
      REQUIRE(counts.wrong == 0);
    }
  }
  CHECK(counts.hit > 5000);  // 8 073 seen
  CHECK(counts.worst < 1e-9);
}

TEST_CASE("Classical far from the origin, in other units, with other speeds", "[engines][cell_walk]") {
  Draw draw(1430);
  INFO("seed 1430");
  for (int i = 0; i < 300; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    Scene scene = drawn_scene(draw, dimension);
    Query query{draw.vec(dimension, -1e9, 1e9), draw.vec(dimension, -1, 1), {}};
    INFO(stream(scene, query));
    const Answer exact = oracle::Oracle(scene).first_hit(query), given = CellWalk(scene).first_hit(query);
    INFO(line(exact, dimension) << line(given, dimension));
    REQUIRE(same_obstacle(exact, given));
    // The start's digits within the cell are all kept.
    if (given.time) CHECK(*given.time == Approx(*exact.time).epsilon(0).margin(1e-11 * (1 + *exact.time)));
    const int length = 200 - static_cast<int>(draw.below(400));
    query.x = times_power_of_two(query.x, length);
    Answer other = CellWalk(scaled(scene, length)).first_hit(query);
    if (other.time) other.time = std::ldexp(*other.time, -length);
    CHECK(same(other, given));
  }
}

TEST_CASE("Inside: the smallest lattice, atom and cell", "[engines][cell_walk]") {
  Scene scene = scene_with(2, {lattice_of_vectors({Vec{9, 0}, Vec{0, 9}}, 0.5), hexagonal(1.4)});
  scene.lattices[1].atoms.push_back({{0.1, 0}, 1.6, {}});
  const auto engine = make_engine("classical", scene);
  const auto answer = [&](Vec x, std::optional<ObstacleId> from = {}) {
    const Query query{x, {1, 0.3}, from};
    const Answer given = engine->first_hit(query);
    CHECK(given.outcome == Outcome::inside);
    CHECK(given.obstacle == oracle::Oracle(scene).first_hit(query).obstacle);
    return given.obstacle;
  };
  CHECK(answer({0.1, 0.1}).lattice == 0);
  CHECK(answer({0.1, 0.1}, ObstacleId{}).lattice == 1);
  const ObstacleId smallest = answer({4.4, 4.3});
  CHECK(smallest.atom == 0);
  CHECK_FALSE(answer({4.4, 4.3}, smallest) == smallest);
}

TEST_CASE("One lattice's corridor does not keep the other's obstacles from being hit",
          "[engines][cell_walk]") {
  Scene scene = scene_with(2, {unit_scene(2, 0.1).lattices[0], unit_scene(2, 0.1).lattices[0]});
  const Query query{{0.3, 0.5}, {1, 0}, {}};
  CHECK(make_engine("classical", scene)->first_hit(query).outcome == Outcome::undecided);
  CHECK(make_engine("classical", scene)->first_hit(query, 50).outcome == Outcome::later);
  scene.lattices[1].atoms[0].position = {0, 0.5};
  const Answer answer = make_engine("classical", scene)->first_hit(query);
  CHECK(answer.obstacle.lattice == 1);
  CHECK(*answer.time == Approx(0.6));
}

TEST_CASE("Ten thousand atoms", "[engines][cell_walk]") {
  Draw draw(1440);
  INFO("seed 1440");
  for (const int dimension : {2, 3}) {
    Scene scene = unit_scene(dimension, 0.1);
    scene.lattices[0].atoms.assign(10'000, {});
    for (Atom& atom : scene.lattices[0].atoms)
      atom = {draw.vec(dimension, -1, 1), dimension == 2 ? 1e-5 : 1e-3, {}};
    const auto engine = make_engine("classical", scene);
    const oracle::Oracle oracle(scene);
    for (int i = 0; i < 5; ++i) {
      const Query query{draw.vec(dimension, -1, 1), draw.vec(dimension, -1, 1), {}};
      INFO(stream(unit_scene(dimension, 0.1), query));
      CHECK(same_obstacle(oracle.first_hit(query), engine->first_hit(query)));
    }
  }
}

TEST_CASE("What classical does not do, it says, at once", "[engines][cell_walk]") {
  const Query query{{0.5, 0.4}, {1, 0.3}, {}};
  const auto message = [&](const Scene& scene) {
    const Answer answer = make_engine("classical", scene)->first_hit(query);
    CHECK(answer.unsupported);
    return answer.message;
  };
  using Catch::Contains;
  CHECK_THAT(message(unit_scene(2, 1e6)), Contains("a million obstacles"));
  CHECK_THAT(message(unit_scene(3, 1e300)), Contains("a million obstacles"));
  Scene scene = unit_scene(2, 0.1);
  scene.lattices[0].atoms[0] = {{}, 0, {Vec{1e200, 0}, Vec{0, 1e200}}};
  CHECK_THAT(message(scene), Contains("a million obstacles"));
  scene.lattices[0].atoms[0] = {{}, 0, {Vec{1e-200, 0}, Vec{0, 1}}};
  CHECK_THAT(message(scene), Contains("semiaxes"));
  scene = unit_scene(2, 1e-200);
  scene.lattices[0].vectors[0][0] = 2;
  CHECK_THAT(message(scene), Contains("radii as small"));
  scene = unit_scene(2, 0.1);
  scene.lattices[0].atoms[0].position = {1e30, 0};
  CHECK_THAT(message(scene), Contains("far from the origin"));
  scene = unit_scene(2, 0.1);
  scene.lattices[0].vectors[1] = {1e9, 1};
  CHECK_THAT(message(scene), Contains("flat"));
  scene.lattices[0].vectors[1] = {1e300, 1e300};
  CHECK_THAT(message(scene), Contains("2^500"));
  for (const int exponent : {-501, -500, 500, 501}) {
    const double unit = std::ldexp(1, exponent);
    scene = scene_with(2, {lattice_of_vectors({Vec{unit, 0}, Vec{unit / 8, unit}}, unit / 8)});
    const Answer answer = make_engine("classical", scene)->first_hit({{unit / 2, unit / 16}, {1, 0}, {}});
    CHECK(answer.unsupported == (std::abs(exponent) > 500));
    if (!answer.unsupported) CHECK(answer.obstacle == ObstacleId{0, 0, {1, 0}});
  }
  scene = scene_with(2, {hexagonal(0.1)});
  CHECK(make_engine("classical", scene)->first_hit({{0x1p60, 0}, {1, 0}, {}}).unsupported);
  CHECK(make_engine("classical", scene)->first_hit({{1e308, 1e308}, {1, 0}, {}}).unsupported);
  // A cell that nearly a million obstacles reach into is done, up to the cap on their tests.
  scene = unit_scene(2, 490);
  scene.lattices[0].atoms[0].position = {0.25, 0.25};
  CHECK(make_engine("classical", scene)->first_hit(query).outcome == Outcome::inside);
  // So is a cell of a flatness that the walker bears.
  scene = scene_with(2, {lattice_of_vectors({Vec{1, 0}, Vec{1e4, 1}}, 0.01)});
  const Query flight{{0.5, 0.4}, {1, 0.2347}, {}};
  CHECK(same_obstacle(oracle::Oracle(scene).first_hit(flight),
                      make_engine("classical", scene)->first_hit(flight)));
}
