// Ellipsoids: what is known of them without a second implementation.
#include <catch2/catch.hpp>

#include <lorentz/oracle.hpp>
#include <lorentz/walk.hpp>
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

using Matrix = std::array<Vec, 3>;  // rows

Vec times(const Matrix& map, const Vec& a) {
  Vec image{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) image[i] += map[i][k] * a[k];
  return image;
}

// The scene under a linear map: its balls become ellipsoids, its ellipsoids others.
Scene mapped(const Matrix& map, Scene scene) {
  for (Lattice& lattice : scene.lattices) {
    for (Vec& u : lattice.vectors) u = times(map, u);
    for (Atom& atom : lattice.atoms) {
      atom.position = times(map, atom.position);
      if (atom.is_ball())
        for (int i = 0; i < scene.dimension; ++i) {
          atom.semiaxes.emplace_back();
          atom.semiaxes.back()[i] = atom.radius;
        }
      atom.radius = 0;
      for (Vec& axis : atom.semiaxes) axis = times(map, axis);
    }
  }
  return scene;
}

// Small integers, so that products with numbers of 40 bits are exact.
Matrix integer_map(Draw& draw, int dimension) {
  for (;;) {
    Matrix map{};
    map[2][2] = 1;
    Lattice rows;
    for (int i = 0; i < dimension; ++i) {
      for (int k = 0; k < dimension; ++k) map[i][k] = draw.fraction(1, 7);
      rows.vectors[i] = map[i];
    }
    if (determinant(rows, dimension) != 0) return map;
  }
}

double short_number(double a) {
  return std::round(a * 0x1p40) * 0x1p-40;
}

Vec short_vec(Vec a) {
  for (double& component : a) component = short_number(component);
  return a;
}

Scene short_numbers(Scene scene) {
  for (Lattice& lattice : scene.lattices) {
    for (Vec& u : lattice.vectors) u = short_vec(u);
    for (Atom& atom : lattice.atoms) {
      atom.position = short_vec(atom.position);
      atom.radius = short_number(atom.radius);
      for (Vec& axis : atom.semiaxes) axis = short_vec(axis);
    }
  }
  return scene;
}

}  // namespace

TEST_CASE("A sphere is an ellipsoid: turned axes change nothing, to the bit", "[oracle][ellipsoid]") {
  // Columns of integer matrices that are orthogonal, times 2^-4; their lengths are the radius.
  const std::vector<Vec> flat[] = {{Vec{5, 0}, Vec{0, 5}}, {Vec{3, 4}, Vec{-4, 3}}, {Vec{4, -3}, Vec{3, 4}}};
  const std::vector<Vec> solid[] = {{Vec{3, 0, 0}, Vec{0, 3, 0}, Vec{0, 0, 3}},
                                    {Vec{1, 2, 2}, Vec{2, 1, -2}, Vec{2, -2, 1}},
                                    {Vec{-2, 2, 1}, Vec{1, 2, -2}, Vec{2, 1, 2}}};
  Draw draw(61);
  INFO("seed 61");
  oracle::Request request;
  request.detail = true;
  request.digits = 30;
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const double unit = std::ldexp(1, -4 - static_cast<int>(draw.below(8)));
    const Scene scene = unit_scene(dimension, (dimension == 2 ? 5 : 3) * unit);
    const Query query = query_of(draw, draw.one_in(2) ? Style::generic : Style::near_grid, scene);
    const Answer expected = oracle::Oracle(scene).first_hit(query, request);
    for (const std::vector<Vec>& axes : dimension == 2 ? flat : solid) {
      Scene same_scene = scene;
      Atom& atom = same_scene.lattices[0].atoms[0];
      atom.radius = 0;
      atom.semiaxes = axes;
      for (Vec& axis : atom.semiaxes)
        for (double& component : axis) component *= unit;
      const Answer given = oracle::Oracle(same_scene).first_hit(query, request);
      INFO(stream(same_scene, query) << line(given, dimension) << line(expected, dimension));
      REQUIRE(same(given, expected));
      if (given.outcome != Outcome::hit) continue;
      ++hits;
      REQUIRE(given.time_decimal == expected.time_decimal);
      REQUIRE(given.detail->point == expected.detail->point);
      REQUIRE(given.detail->normal == expected.detail->normal);
      REQUIRE(given.detail->impact_parameter == expected.detail->impact_parameter);
    }
  }
  CHECK(hits > 590);  // 738 seen
}

TEST_CASE("A linear map moves scene and flight together: the same obstacle at the same time, to the bit",
          "[oracle][ellipsoid]") {
  Draw draw(62);
  INFO("seed 62");
  int hits = 0, others = 0;
  for (int i = 0; i < 1500; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Style style = draw.one_in(2) ? Style::generic : Style::near_grid;
    Scene scene = scene_of(draw, style, dimension);
    if (draw.one_in(2)) scene = with_ellipsoids(draw, style, scene);
    if (draw.one_in(3)) scene = unit_scene(dimension, std::exp2(draw.between(-20, -2)));
    if (draw.one_in(8)) scene = unit_scene(dimension, draw.between(40, 1000));  // which of many contains x?
    scene = short_numbers(scene);
    Query query = query_of(draw, style, scene);
    query.x = short_vec(query.x), query.v = short_vec(query.v);
    if (query.v == Vec{}) continue;
    const Matrix map = integer_map(draw, dimension);
    const Answer here = oracle::Oracle(scene).first_hit(query);
    const Answer there =
        oracle::Oracle(mapped(map, scene)).first_hit({times(map, query.x), times(map, query.v), query.from});
    INFO(stream(scene, query) << line(here, dimension) << line(there, dimension));
    REQUIRE(same(here, there));
    ++(here.outcome == Outcome::hit ? hits : others);
  }
  CHECK(hits > 700);    // 736 seen
  CHECK(others > 610);  // 763 seen
}

TEST_CASE("An ellipse hit by hand", "[oracle][ellipsoid]") {
  Scene scene = unit_scene(2, 1);
  scene.lattices[0].vectors = {Vec{100, 0}, Vec{0, 100}};
  scene.lattices[0].atoms[0] = {Vec{}, 0, {Vec{4, 0}, Vec{0, 2}}};  // x^2/16 + y^2/4 = 1
  const oracle::Oracle oracle(scene);
  oracle::Request request;
  request.detail = true;
  // At y = 6/5 the ellipse stands at x = 4 * 4/5 = 16/5; binary64 has neither: take y = 0 and x = 0.
  const Answer along = oracle.first_hit({{10, 0}, {-1, 0}, {}}, request);
  CHECK(along.time == 6.0);
  CHECK(along.detail->normal == Vec{1, 0});
  const Answer across = oracle.first_hit({{0, 10}, {0, -2}, {}}, request);
  CHECK(across.time == 4.0);
  CHECK(across.detail->normal == Vec{0, 1});
  // The tangent at the top does not hit; half a unit below it does.
  CHECK(oracle.first_hit({{-50, 2}, {1, 0}, {}}).outcome == Outcome::never);
  CHECK(oracle.first_hit({{-50, 2 - 0x1p-51}, {1, 0}, {}}).outcome == Outcome::hit);
  CHECK(oracle.first_hit({{3.9, 0}, {1, 0}, {}}).outcome == Outcome::inside);
  CHECK(oracle.first_hit({{4, 0}, {1, 0}, {}}).obstacle.cell[0] == Integer(1));
  CHECK(oracle.first_hit({{4, 0}, {-1, 0}, {}}).time == 0.0);
}
