// vast-ellipsoids: tilted ellipsoids of hundreds to thousands of cells; nearly every start is in many of
// them. The answer is the smallest of those that contain it. An engine that finds it without looking at all
// of them walks the rows of the lattice in order, and has to see lattice and start in the same coordinates.

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/drawn_flights.hpp"
#include "question/cases/scenes.hpp"

namespace lorentz::cases {
namespace {

Atom drawn_vast(Random& drawn, int dimension) {
  Atom atom;
  const double low = dimension == 3 ? 3.6 : 33, high = dimension == 3 ? 5.5 : 45;
  for (int i = 0; i < dimension; ++i) atom.position[i] = drawn.one_in(2) ? 0 : drawn.uniform();
  const Vec a = drawn.direction(2);
  atom.semiaxes = {scaled(a, drawn.between(low, high)), scaled({-a[1], a[0], 0}, drawn.between(low, high))};
  if (dimension == 3) atom.semiaxes.push_back({0, 0, drawn.between(low, high)});
  return atom;
}

void make_vast(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const int dimension = drawn.one_in(4) ? 2 : 3;
  made.scene = drawn.one_in(2) ? unit_scene(dimension, 1) : drawn_crystal(drawn, dimension).scene;
  Lattice& lattice = made.scene.lattices[0];
  lattice.atoms = {drawn_vast(drawn, dimension)};
  made.query.x = point_in_cell(random, made.scene);
  made.query.v = random.direction(dimension);
  if (!tagged(made.tags, random.one_in(2), "leaving", "inside")) return;
  const Answer answer = oracle_of(made.scene).first_hit(made.query);
  if (answer.outcome == Outcome::inside) made.query.from = answer.obstacle;
}

}  // namespace

Family vast_ellipsoids() {
  return {"vast-ellipsoids",
          "Ellipsoids of up to some thousand cells: the smallest of many that contain the start.",
          {{"inside", "the smallest of all"}, {"leaving", "`from` is the smallest: the next one"}},
          make_vast};
}

}  // namespace lorentz::cases
