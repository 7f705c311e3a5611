// The two oracles share neither code nor arithmetic: wherever walk can go, they must say the same, to the
// bit.
#include <catch2/catch.hpp>

#include <lorentz/oracle.hpp>
#include <lorentz/walk.hpp>
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

struct Counts {
  int hit = 0, never = 0, inside = 0, undecided = 0;
};

void hold_against_each_other(const Scene& scene, const Query& query, Counts& counts) {
  const oracle::Oracle first(scene);
  const oracle::Walk second(scene, 1500);
  for (const Query& one : {query, reversed(query)}) {
    const Answer expected = second.first_hit(one);
    if (expected.outcome == Outcome::undecided) {
      ++counts.undecided;
      continue;
    }
    counts.hit += expected.outcome == Outcome::hit;
    counts.never += expected.outcome == Outcome::never;
    counts.inside += expected.outcome == Outcome::inside;
    const Answer given = first.first_hit(one);
    INFO(stream(scene, one) << "walk:   " << line(expected, scene.dimension)
                            << "oracle: " << line(given, scene.dimension));
    REQUIRE(same(given, expected));
  }
}

enum class Shapes { balls, ellipsoids };

Counts campaign(std::uint64_t seed, Style style, int dimension, int cases, Shapes shapes = Shapes::balls) {
  INFO("seed " << seed);
  Draw draw(seed);
  Counts counts;
  for (int i = 0; i < cases; ++i) {
    Scene scene = scene_of(draw, style, dimension);
    if (shapes == Shapes::ellipsoids) scene = with_ellipsoids(draw, style, scene);
    hold_against_each_other(scene, query_of(draw, style, scene), counts);
  }
  return counts;
}

// The campaign must have met every outcome, or it tests less than it says.
void require_variety(const Counts& counts, int cases) {
  CHECK(counts.hit > cases / 4);
  CHECK(counts.inside > cases / 8);
  CHECK(counts.undecided < cases / 4);
}

}  // namespace

TEST_CASE("Oracle equals walk on generic scenes", "[oracle][two_oracles]") {
  require_variety(campaign(101, Style::generic, 2, 2000), 2000);
  require_variety(campaign(102, Style::generic, 3, 1000), 1000);
}

TEST_CASE("Oracle equals walk on a coarse grid: ties, tangents, rational slopes", "[oracle][two_oracles]") {
  const Counts flat = campaign(201, Style::grid, 2, 3000), solid = campaign(202, Style::grid, 3, 1500);
  require_variety(flat, 3000);
  require_variety(solid, 1500);
  CHECK(flat.never > 100);   // 109 seen
  CHECK(solid.never > 120);  // 151 seen
}

TEST_CASE("Oracle equals walk a little off the grid: near-rational slopes, nearly touching, nearly parallel",
          "[oracle][two_oracles]") {
  require_variety(campaign(301, Style::near_grid, 2, 3000), 3000);
  require_variety(campaign(302, Style::near_grid, 3, 1500), 1500);
}

TEST_CASE("Oracle equals walk on ellipsoids, alone and mixed with balls", "[oracle][two_oracles]") {
  std::uint64_t seed = 350;
  for (const Style style : {Style::generic, Style::grid, Style::near_grid}) {
    require_variety(campaign(++seed, style, 2, 2000, Shapes::ellipsoids), 2000);
    require_variety(campaign(++seed, style, 3, 1000, Shapes::ellipsoids), 1000);
  }
}

TEST_CASE("Oracle equals walk on slender ellipsoids", "[oracle][two_oracles]") {
  Draw draw(371);
  Counts counts;
  for (int i = 0; i < 300; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    Scene scene = with_ellipsoids(draw, Style::generic, scene_of(draw, Style::generic, dimension));
    for (Lattice& lattice : scene.lattices)
      for (Atom& atom : lattice.atoms)
        for (std::size_t axis = 0; axis < atom.semiaxes.size(); ++axis) {
          const double stretch = axis == 0 ? draw.between(0.5, 5) : draw.between(0.02, 0.3);
          for (double& component : atom.semiaxes[axis]) component *= stretch;
        }
    hold_against_each_other(scene, query_of(draw, Style::near_grid, scene), counts);
  }
  CHECK(counts.hit > 200);  // 378 seen
}

TEST_CASE("Oracle equals walk on small obstacles", "[oracle][two_oracles]") {
  Draw draw(401);
  Counts counts;
  for (int i = 0; i < 300; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Scene scene = unit_scene(
        dimension, dimension == 2 ? std::exp2(draw.between(-9, -4)) : std::exp2(draw.between(-4.5, -3)));
    hold_against_each_other(scene, {draw.vec(dimension, 0, 1), draw.vec(dimension, -1, 1), {}}, counts);
  }
  CHECK(counts.hit > 400);  // 592 seen
}

TEST_CASE("Oracle equals walk on dense walls and rods of overlapping obstacles", "[oracle][two_oracles]") {
  // Spacing far below the radius in one or two directions: many rows in every plane, many obstacles in every
  // row.
  Draw draw(501);
  Counts counts;
  for (int i = 0; i < 150; ++i) {
    const int dimension = draw.one_in(3) ? 2 : 3;
    Scene scene = unit_scene(dimension, draw.between(0.2, 0.4));
    for (int k = 0; k + 1 < dimension; ++k)
      if (k == 0 || draw.one_in(2)) scene.lattices[0].vectors[k][k] = draw.between(0.03, 0.1);
    scene.lattices[0].vectors[0][dimension - 1] = draw.one_in(2) ? 0 : draw.tiny(-30, -4);
    Vec x = draw.vec(dimension, 0, 1);
    x[dimension - 1] = draw.between(0.35, 0.65);
    if (dimension == 3 && scene.lattices[0].vectors[1][1] == 1) x[1] = draw.between(0.35, 0.65);
    hold_against_each_other(scene, {x, vec_of(draw, Style::near_grid, dimension, 2), {}}, counts);
  }
  CHECK(counts.hit > 200);  // 252 seen
}

TEST_CASE("Walls so dense that their obstacles cannot be told apart by size", "[oracle][two_oracles]") {
  // Spacing 2^-k: far beyond any walk. The plane x = 1 acts like a wall that the ball touches at 1 - r (its
  // centre line hits some centre within 2^-k), so the time is known to about 4^-k.
  for (const int k : {10, 30, 44, 60, 200}) {
    Scene scene = unit_scene(3, 0.4);
    scene.lattices[0].vectors[1][1] = scene.lattices[0].vectors[2][2] = std::ldexp(1, -k);
    for (const Vec v : {Vec{1, 0.3, 0.2}, Vec{1e-3, 0.3, 0.2}, Vec{1, 0, 0}}) {
      const Answer answer = oracle::Oracle(scene).first_hit({{0.5, 0.5, 0.1}, v, {}});
      REQUIRE(answer.outcome == Outcome::hit);
      CHECK(answer.obstacle.cell[0] == Integer(1));
      CHECK(*answer.time * v[0] ==
            Approx(0.1).epsilon(std::max(std::ldexp(4, -2 * k) / 0.4, 1e-14) * (1 + 1 / v[0])));
    }
  }
}

TEST_CASE("Oracle equals walk, long campaign", "[oracle][two_oracles][long]") {
  std::uint64_t seed = 1000;
  for (const Style style : {Style::generic, Style::grid, Style::near_grid})
    for (const int dimension : {2, 3})
      for (const Shapes shapes : {Shapes::balls, Shapes::ellipsoids})
        require_variety(campaign(++seed, style, dimension, 60'000, shapes), 60'000);
}
