// Directions through layers, open or closed: against closed forms, the oracle, and the same question in other words.
#include <lorentz/horizon.hpp>

#include <catch2/catch.hpp>

#include <cmath>

#include <lorentz/errors.hpp>
#include <lorentz/oracle.hpp>
#include "tests/oracle/horizon_support.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using oracle::look_along;
using oracle::OpenDirection;

namespace {

Scene layer_with(const Vec& a, const Vec& b, std::vector<Atom> atoms) {
  Scene scene = scene_with(3, {a, b}, std::move(atoms));
  scene.lattices[0].missing = 1;
  return scene;
}

Scene one_ball(const Vec& a, const Vec& b, double radius) {
  return layer_with(a, b, {Atom{{}, radius, {}}});
}

Vec combined(const Vec& a, double k, const Vec& b) {
  return {a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]};
}

Vec negative(const Vec& a) {
  return {-a[0], -a[1], -a[2]};
}

// What a line meets, from far before the layer.
Outcome outcome_of_line(const oracle::Oracle& oracle, const Vec& point, const Vec& v) {
  return oracle.first_hit(Query{combined(point, -1024, v), v, {}}).outcome;
}

Scene drawn_layer(Draw& draw) {
  Lattice lattice = short_lattice(draw, 3);
  lattice.vectors[2] = {};
  lattice.missing = 1;
  lattice.atoms.resize(1 + draw.below(3));
  const bool ellipsoids = draw.one_in(4);
  const double r = static_cast<double>(8 + draw.below(40)) / 64;
  for (Atom& atom : lattice.atoms) {
    for (int k = 0; k < 3; ++k) atom.position[k] = short_number(draw, 1);
    if (ellipsoids)
      atom.semiaxes = {{r, r / 2, 0}, {0, r / 4, -r}, {r / 8, 0, r / 2}};
    else
      atom.radius = static_cast<double>(8 + draw.below(40)) / 64;
  }
  Scene scene;
  scene.dimension = 3;
  scene.lattices.push_back(lattice);
  return scene;
}

// Another basis of the layer, each obstacle a lattice of its own, in another of its cells.
Scene reworded(const Scene& scene) {
  const auto& [a, b, none] = scene.lattices[0].vectors;
  Scene other = scene;
  other.lattices.clear();
  for (Atom atom : scene.lattices[0].atoms) {
    atom.position = combined(combined(atom.position, 2, a), -3, b);
    other.lattices.push_back({{combined(b, 2, a), negative(combined(a, 1, b))}, {atom}, 1});
  }
  return other;
}

}  // namespace

TEST_CASE("Horizon: directions through layers, by closed forms", "[oracle][horizon][ranks]") {
  // Seen along v the rectangle 5 x 4 is one of 5 cos(v, z) x 4.
  const Vec a{5, 0, 0}, b{0, 4, 0};
  const auto radius_along = [&](double r, const Vec& v) {
    const OpenDirection found = look_along(one_ball(a, b, r), v);
    CHECK(found.open == found.way.has_value());
    return found.way ? found.way->radius : 0;
  };
  CHECK(radius_along(1, {0, 0, 1}) == Approx(std::sqrt(41) / 2 - 1).epsilon(1e-15));
  CHECK(radius_along(1, {4, 0, 3}) == 1.5);  // 3 x 4
  CHECK(radius_along(1, {-4e200, 0, -3e200}) == 1.5);
  CHECK(radius_along(2.5, {4, 0, 3}) == 0);  // three discs meet in a point
  CHECK(radius_along(std::nextafter(2.5, 0), {4, 0, 3}) == Approx(0x1p-51).epsilon(1e-9));
  CHECK(radius_along(std::nextafter(2.5, 3), {4, 0, 3}) == 0);
  // Along the rows of the layer's shortest vector, hardly tilted: ways between the rows.
  CHECK(radius_along(1, {0, 1, 1e-9}) == Approx(1.5));
  CHECK(radius_along(1, {0.1, 1, 1e-9}) == 0);

  const OpenDirection along = look_along(one_ball(a, b, 3), {1, 0.37, 0});
  CHECK(along.open);
  CHECK(!along.way);
}

TEST_CASE("Horizon: directions through layers, by the oracle and in other words",
          "[oracle][horizon][ranks]") {
  Draw draw(41);
  int open = 0, closed = 0, flights = 0;
  for (int round = 0; round < 300; ++round) {
    const Scene scene = drawn_layer(draw);
    Vec v{};
    while (v == Vec{}) v = {short_number(draw, 2), short_number(draw, 2), short_number(draw, 2)};
    std::string line;
    append_scene_line(line, scene);
    INFO(line << " along " << v[0] << " " << v[1] << " " << v[2]);
    const OpenDirection found = look_along(scene, v);
    const OpenDirection other = look_along(reworded(scene), negative(v));
    CHECK(found.open == other.open);
    (found.open ? open : closed)++;
    const oracle::Oracle oracle(scene);
    if (found.way && found.way->inside) {
      CHECK(found.way->radius > 0);
      CHECK(outcome_of_line(oracle, found.way->point, v) == Outcome::never);
      ++flights;
    }
    for (int shot = 0; shot < 100 && !found.open; ++shot)
      CHECK(outcome_of_line(oracle, draw.vec(3, -1, 1), v) != Outcome::never);
  }
  CHECK(open > 100);
  CHECK(closed > 50);
  CHECK(flights > open / 10 * 9);
}

TEST_CASE("Horizon: directions that are refused", "[oracle][horizon][ranks]") {
  const Scene layer = one_ball({1, 0, 0}, {0, 1, 0}, 0.25);
  Scene crystal = layer;
  crystal.lattices[0].missing = 0;
  crystal.lattices[0].vectors[2] = {0, 0, 1};
  Scene two = layer;
  two.lattices.push_back(layer.lattices[0]);
  two.lattices[1].vectors[0] = {2, 0, 0};
  const Scene pair = layer_with({1, 0, 0}, {0, 1, 0}, {Atom{{}, 0.25, {}}, Atom{{0, 0, 1}, 0.25, {}}});
  for (const auto& [scene, v] : {std::pair(layer, Vec{0, 0, 0}),
                                 {layer, Vec{0, 0, NAN}},
                                 {crystal, Vec{0, 0, 1}},
                                 {two, Vec{0, 0, 1}},
                                 {pair, Vec{1, 0, 1e-9}}})
    CHECK_THROWS_AS(look_along(scene, v), InputError);
}
