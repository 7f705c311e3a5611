// mixture: superpositions of lattices that are themselves motifs, of balls and ellipsoids. Some of these hold
// many cells, and some are 2^13 times as long as wide. An engine that keeps lists by lattice, by atom and by
// shape has to keep them apart here. If obstacles of many cells contain the start, the answer is the smallest
// of a thousand.

#include <lorentz/geometry.hpp>
#include <lorentz/oracle.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/drawn_flights.hpp"
#include "question/cases/scenes.hpp"

namespace lorentz::cases {
namespace {

// Semiaxes along a drawn frame in the plane of the first two axes, the third upright.
Atom mixed_obstacle(Random& drawn, int dimension, double size) {
  Atom atom;
  for (int i = 0; i < dimension; ++i) atom.position[i] = drawn.one_in(2) ? 0 : drawn.uniform();
  if (drawn.one_in(2)) {
    atom.radius = size;
    return atom;
  }
  const Vec a = drawn.direction(2);
  const double slender = drawn.one_in(3) ? drawn.octave(-13, -4) : drawn.between(0.1, 1);
  atom.semiaxes = {scaled(a, size), scaled({-a[1], a[0], 0}, size * slender)};
  if (dimension == 3) atom.semiaxes.push_back({0, 0, size * drawn.between(0.2, 1)});
  return atom;
}

Lattice drawn_lattice(Random& drawn, int dimension, bool many_cells) {
  Lattice lattice = drawn.one_in(2) ? unit_scene(dimension, 1).lattices[0]
                                    : drawn_crystal(drawn, dimension).scene.lattices[0];
  const double spacing = drawn.one_in(2) ? 1 : drawn.between(0.6, 1.7);
  for (Vec& vector : lattice.vectors) vector = scaled(vector, spacing);
  lattice.atoms.clear();
  for (std::int64_t n = drawn.integer(1, 3); n > 0; --n)
    lattice.atoms.push_back(mixed_obstacle(drawn, dimension, drawn.octave(-9, -3)));
  if (many_cells)
    lattice.atoms[0] = mixed_obstacle(drawn, dimension, drawn.octave(0, dimension == 2 ? 3 : 1));
  return lattice;
}

// Excludes the obstacle that contains x by `from`, up to three times in turn; only the last one stays
// excluded.
void leave(Random& random, Case& made) {
  const oracle::Oracle& oracle = oracle_of(made.scene);
  for (int i = 0; i < 3; ++i) {
    const Answer answer = oracle.first_hit(made.query);
    if (answer.outcome != Outcome::inside) return;
    made.query.from = answer.obstacle;
    if (random.one_in(2)) return;
  }
}

void make_mixture(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  made.scene.dimension = drawn.one_in(3) ? 3 : 2;
  const bool many_cells = tagged(made.tags, drawn.one_in(3), "many-cells", "small");
  for (std::int64_t n = drawn.integer(1, 3); n > 0; --n)
    made.scene.lattices.push_back(drawn_lattice(drawn, made.scene.dimension, many_cells && n == 1));
  made.query.x = many_cells ? point_in_cell(random, made.scene) : free_point(random, made.scene);
  made.query.v = random.direction(made.scene.dimension);
  if (tagged(made.tags, many_cells && random.one_in(2), "leaving")) leave(random, made);
}

}  // namespace

Family mixture() {
  return {"mixture",
          "Superposed motifs of balls and ellipsoids, some of many cells.",
          {{"small", "one to three lattices, each with one to three obstacles a cell, 2^-9 to 2^-3 large"},
           {"many-cells", "an obstacle of the last lattice holds up to 2^6 cells, and more in space"},
           {"leaving", "`from` is one of the obstacles that contain the start"}},
          make_mixture};
}

}  // namespace lorentz::cases
