// rows-and-layers: lattices that repeat in fewer directions than there are, alone and with others.
//
// A row or a layer is cut from a crystal: it keeps the first primitive vectors. Its hard cases differ from
// those of a crystal, where something is always hit in the end. A flight beside a row is long, and one away
// from it hits nothing. A flight in the plane of a layer is a flight in two dimensions, exactly or nearly.

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/drawn_flights.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {
namespace {

Lattice cut(Lattice lattice, int dimension, int rank) {
  lattice.rank = rank;
  for (int i = rank; i < dimension; ++i) lattice.vectors[i] = {};
  return lattice;
}

// A lattice of 1 to d - 1 vectors; in half of the scenes also another lattice with any number of them.
Scene drawn_scene(Random& drawn, std::vector<std::string>& tags) {
  const int dimension = drawn.one_in(4) ? 2 : 3;
  Scene scene = drawn_crystal(drawn, dimension).scene;
  scale_obstacles(scene, drawn.one_in(2) ? 1 : drawn.octave(-10, 0));
  const int rank = dimension == 2 || drawn.one_in(4) ? 1 : 2;
  tagged(tags, rank == 2, "layer", "row");
  const Lattice whole = scene.lattices[0];
  scene.lattices[0] = cut(whole, dimension, rank);
  if (tagged(tags, drawn.one_in(2), "mixed")) {
    Lattice other = cut(whole, dimension, static_cast<int>(drawn.integer(0, dimension)));
    for (Atom& atom : other.atoms)
      for (int i = 0; i < dimension; ++i)
        atom.position[i] += drawn.between(0.3, 0.7) * length(whole.vectors[i]);
    scene.lattices.push_back(std::move(other));
  }
  return scene;
}

// A velocity along the lattice, with small integers, exactly or up to ulps and tilts.
Vec along(Random& random, NumberFormat precision, const Lattice& lattice, int dimension) {
  Vec v{};
  for (int i = 0; i < lattice.rank_in(dimension); ++i) v = plus(v, random.whole(-5, 5), lattice.vectors[i]);
  if (v == Vec{}) v = lattice.vectors[0];
  if (random.one_in(2)) return v;
  return sum(v, random.vector(dimension, length(v) * random.octave(-50 + missing_bits(precision), -4)));
}

void make_case(Source& source, Case& made) {
  Random& random = source.random;
  made.scene = drawn_scene(source.scene, made.tags);
  const int dimension = made.scene.dimension;
  const Lattice& lattice = made.scene.lattices[0];
  const Atom& atom = lattice.atoms[random.below(lattice.atoms.size())];
  Vec target = atom.position;
  const IntVec cell = drawn_integers(random, lattice.rank_in(dimension), 50);
  for (int i = 0; i < lattice.rank_in(dimension); ++i)
    target = plus(target, static_cast<double>(cell[i]), lattice.vectors[i]);
  const double reach = atom.is_ball() ? atom.radius : length(atom.semiaxes[0]);
  const Vec direction = random.direction(dimension);
  made.query = {plus(target, -reach * random.octave(1, 12), direction), direction, {}};
  Vec &x = made.query.x, &v = made.query.v;
  const std::string_view way = drawn_tag(random, made.tags, {"aimed", "away", "along", "leaving", "edge"});
  if (way == "away") {
    v = random.direction(dimension);
  } else if (way == "along") {
    v = along(random, source.precision, lattice, dimension);
    x = sum(target, random.vector(dimension, reach * random.between(1, 3)));
  } else if (way == "leaving") {
    made.query.from = obstacle(cell, static_cast<int>(&atom - lattice.atoms.data()));
    x = plus(target, reach, direction);
    v = random.one_in(2) ? along(random, source.precision, lattice, dimension) : random.direction(dimension);
  } else if (way == "edge") {
    x = sum(x, random.vector(dimension, reach * random.between(0.1, 0.9)));
    move_to_edge([&] { return drawn_off_edge(random, source.precision); }, made.scene, oracle_of(made.scene),
                 made.query, source.precision);
  }
}

}  // namespace

Family rows_and_layers() {
  return {"rows-and-layers",
          "Lattices that repeat in fewer directions: rows and layers, alone, and among others.",
          {{"row", "one primitive vector"},
           {"layer", "two primitive vectors, in space"},
           {"mixed", "and another lattice: of single obstacles, a row, a layer or a crystal"},
           {"aimed", "at an obstacle, from as far as 4000 radii away"},
           {"away", "in any direction: mostly nothing is hit"},
           {"along", "along a row, or in the plane of a layer, exactly or nearly"},
           {"leaving", "starts on an obstacle that it leaves"},
           {"edge", "past the edge of what is hit first, on either side"}},
          make_case};
}

}  // namespace lorentz::cases
