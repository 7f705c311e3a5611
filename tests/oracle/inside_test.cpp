// The smallest obstacle around x, for radii of any number of cells.
#include <catch2/catch.hpp>

#include <chrono>

#include <lorentz/oracle.hpp>
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

// By trying all cells, in integers: grid coordinates are multiples of 1/4.
std::optional<Cell> smallest_by_trying(const Scene& scene, const Query& query, int range) {
  const Lattice& lattice = scene.lattices[0];
  const int high = scene.dimension == 3 ? range : 0;
  for (int a = -range; a <= range; ++a)
    for (int b = -range; b <= range; ++b)
      for (int c = -high; c <= high; ++c) {
        const Cell cell{Integer(a), Integer(b), Integer(c)};
        if (query.from && query.from->cell == cell) continue;
        double distance2 = 0;
        for (int k = 0; k < scene.dimension; ++k) {
          const double component = lattice.atoms[0].position[k] - query.x[k] + a * lattice.vectors[0][k] +
                                   b * lattice.vectors[1][k] + c * lattice.vectors[2][k];
          distance2 += component * component;
        }
        if (distance2 < lattice.atoms[0].radius * lattice.atoms[0].radius) return cell;
      }
  return std::nullopt;
}

}  // namespace

TEST_CASE("The smallest obstacle around x, against trying all", "[oracle][inside]") {
  Draw draw(61);
  INFO("seed 61");
  int several = 0;
  for (int i = 0; i < 400; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    Scene scene = scene_of(draw, Style::grid, dimension);
    scene.lattices.resize(1);
    scene.lattices[0].atoms.resize(1);
    if (std::fabs(determinant(scene.lattices[0], dimension)) < 0.5) continue;
    scene.lattices[0].atoms[0].radius = draw.one_in(2) ? 0.25 * static_cast<double>(1 + draw.below(8)) : 0.75;
    Query query{vec_of(draw, Style::grid, dimension, 1), {1, 0, 0}, {}};
    // Trying must reach all cells; 40 is enough for these determinants and radii.
    auto expected = smallest_by_trying(scene, query, dimension == 2 ? 60 : 30);
    if (expected && draw.one_in(2)) {
      query.from = ObstacleId{0, 0, *expected};
      expected = smallest_by_trying(scene, query, dimension == 2 ? 60 : 30);
      several += expected.has_value();
    }
    const Answer answer = oracle::Oracle(scene).first_hit(query);
    INFO(stream(scene, query) << line(answer, dimension));
    REQUIRE((answer.outcome == Outcome::inside) == expected.has_value());
    if (expected) REQUIRE(answer.obstacle.cell == *expected);
  }
  CHECK(several > 50);  // 86 seen
}

TEST_CASE("A radius of many cells is answered, and at once", "[oracle][inside]") {
  // In the square the first disc is the leftmost whose disc holds x: n_1 = -(ceil(r) - 1), n_2 as small as
  // possible.
  const auto start = std::chrono::steady_clock::now();
  const Answer flat = oracle::Oracle(unit_scene(2, 1000000.5)).first_hit({{0, 0}, {1, 0}, {}});
  REQUIRE(flat.outcome == Outcome::inside);
  // (10^6 + 1/2)^2 - 10^12 = 10^6 + 1/4: n_2^2 < 10^6 + 1/4.
  CHECK(flat.obstacle.cell == Cell{Integer(-1000000), Integer(-1000), Integer(0)});
  const Answer solid = oracle::Oracle(unit_scene(3, 1000000.5)).first_hit({{0, 0, 0}, {1, 0, 0}, {}});
  REQUIRE(solid.outcome == Outcome::inside);
  // n_2^2 + n_3^2 < 10^6 + 1/4: n_2 = -1000, n_3 = 0.
  CHECK(solid.obstacle.cell == Cell{Integer(-1000000), Integer(-1000), Integer(0)});
  CHECK(oracle::Oracle(unit_scene(3, 0x1p200)).first_hit({{0, 0, 0}, {1, 0, 0}, {}}).outcome ==
        Outcome::inside);
  // Dense and skewed at once: the answer is checked by what it must satisfy.
  Scene skewed = unit_scene(2, 0.83);
  skewed.lattices[0].vectors = {Vec{0, 1e-7}, Vec{2e-4, 3}, Vec{}};
  const Answer dense = oracle::Oracle(skewed).first_hit({{0.3, 0.4}, {1, 0.3}, {}});
  REQUIRE(dense.outcome == Outcome::inside);
  CHECK(dense.obstacle.cell == Cell{Integer(-169466182197), Integer(5649), Integer(0)});
  // No timed test: but a search through all 10^12 or 10^18 obstacles would not end today.
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::minutes(5));
}
