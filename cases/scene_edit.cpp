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

ObstacleId obstacle(std::int64_t a, std::int64_t b, std::int64_t c, int atom) {
  return {0, atom, {Integer(a), Integer(b), Integer(c)}};
}

}  // namespace lorentz::cases
