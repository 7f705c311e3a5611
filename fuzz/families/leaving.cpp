// leaving: the question that a simulation asks at every step. The particle is on an obstacle that it has just
// hit, leaves by the cosine law (the flux of a gas in equilibrium), and names the obstacle in `from`. The
// start is on the surface up to rounding, so half of the starts are inside by an ulp. The next obstacle is
// often a neighbour, at a slope that no uniform start has. Programs that take the first cell for empty, or
// that exclude the obstacle left as the next one, fail here.
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"

namespace lorentz::cases {
namespace {

// A direction off the surface with the outward unit normal n: its cosine c has the density 2 c (3D), c (2D).
Vec outwards(Random& random, const Vec& n, int dimension) {
  constexpr int kTries = 100;
  for (int tries = 0; tries < kTries; ++tries) {
    const Vec v = random.direction(dimension);
    if (lorentz::dot(n, v) > random.uniform()) return v;
  }
  return n;
}

Scene left_scene(Random& drawn, std::vector<std::string>& tags) {
  const int dimension = drawn.one_in(3) ? 3 : 2;
  const bool unit = tagged(tags, drawn.one_in(2), "unit-cell", "crystal");
  Scene scene =
      unit ? unit_scene(dimension, drawn.one_in(3) ? drawn.octave(-12, -3) : drawn.between(0.05, 0.5))
           : drawn_crystal(drawn, dimension).scene;
  if (!unit) scale_obstacles(scene, drawn.one_in(3) ? drawn.octave(-10, -2) : drawn.between(0.2, 1.0));
  return scene;
}

void make_leaving(Source& source, Case& made) {
  Random& random = source.random;
  made.scene = left_scene(source.scene, made.tags);
  const int dimension = made.scene.dimension;
  const Lattice& lattice = made.scene.lattices[0];
  const auto which = static_cast<int>(random.below(lattice.atoms.size()));
  const bool home = random.one_in(2);
  const IntVec cell = home ? IntVec{} : drawn_integers(random, dimension, 9);
  const Atom& atom = lattice.atoms[which];
  Vec n = random.direction(dimension);
  const bool few_bits = random.one_in(4);  // directions and starts that a person would type
  if (few_bits) {
    made.tags.push_back("few-bits");
    for (double& component : n) component = std::round(32 * component) / 32;
  }
  made.query.x = sum(sum(atom.position, cartesian(lattice, cell)), scaled(n, atom.radius));
  made.query.v = outwards(random, scaled(n, 1 / length(n)), dimension);
  if (few_bits) {
    const double size = random.one_in(2) ? 8 : 16;
    for (double& component : made.query.v) component = std::round(size * component);
    if (made.query.v == Vec{}) made.query.v = n;
  }
  made.query.from = obstacle(cell, which);
  tagged(made.tags, home, "home-cell", "other-cell");
}

}  // namespace

Family leaving() {
  return {"leaving",
          "Flights that leave the obstacle they start on, by the cosine law, and say so.",
          {{"unit-cell", "the square or cubic lattice"},
           {"crystal", "another lattice, or several obstacles a cell"},
           {"home-cell", "from an obstacle of the cell 0"},
           {"other-cell", "from a cell up to 9 away"},
           {"few-bits", "start and direction rounded to a few bits, off the surface"}},
          make_leaving};
}

}  // namespace lorentz::cases
