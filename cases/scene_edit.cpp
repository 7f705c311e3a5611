#include "cases/scene_edit.hpp"

#include <lorentz/geometry.hpp>

namespace lorentz::cases {

Scene lattice_scene(int dimension, const std::array<Vec, 3>& vectors, double radius) {
  Scene scene = unit_scene(dimension, radius);
  scene.lattices[0].vectors = vectors;
  return scene;
}

void set_radius(Scene& scene, double radius) {
  for_each_atom(scene, [&](Atom& atom) {
    if (atom.is_ball()) atom.radius = radius;
  });
}

void scale_obstacles(Scene& scene, double factor) {
  for_each_atom(scene, [&](Atom& atom) {
    atom.radius *= factor;
    for (Vec& axis : atom.semiaxes) axis = scaled(axis, factor);
  });
}

void scale_places(Scene& scene, double factor) {
  for (Lattice& lattice : scene.lattices) {
    for (Vec& u : lattice.vectors) u = scaled(u, factor);
    for (Atom& atom : lattice.atoms) atom.position = scaled(atom.position, factor);
  }
}

Vec image(const std::vector<Vec>& semiaxes, const Vec& y) {
  Vec result{};
  for (std::size_t i = 0; i < semiaxes.size(); ++i) result = plus(result, y[i], semiaxes[i]);
  return result;
}

Vec drawn_across(Random& random, const Vec& v, int dimension) {
  const Vec n = dimension == 2 ? Vec{-v[1] * random.sign(), v[0], 0} : cross(v, random.direction(3));
  const double size = length(n);
  return size > 0 ? scaled(n, 1 / size) : Vec{0, 1, 0};
}

std::array<Vec, 3> drawn_frame(Random& random, const Vec& a, int dimension) {
  if (dimension == 2) return {a, Vec{-a[1], a[0], 0}, Vec{0, 0, 1}};
  Vec b = cross(a, random.direction(3));
  if (b == Vec{}) b = cross(a, a[0] == 0 ? Vec{1, 0, 0} : Vec{0, 1, 0});
  b = scaled(b, 1 / length(b));
  return {a, b, cross(a, b)};
}

}  // namespace lorentz::cases
