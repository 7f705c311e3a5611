// crystals, superpositions, ellipsoids: scenes beyond one ball per cell, each with drawn, near-rational and
// grazing flights.
//
// Several obstacles per cell are several questions, of which the earliest answer counts; times from different
// offsets decide their order. Lattices turned by pi/5 or pi/7, whose cosines are irrational, have no common
// period; in binary64 they have one of 10^30 cells. Obstacles of the two come arbitrarily near to each other.
// An ellipsoid is a ball in another metric: slender ones stretch the cell by as much as they are slender, and
// a poorly reduced cell then loses digits. Grazing flights are drawn ones that are moved across until the
// first obstacle is passed or met within 2^-10 to 2^-50 of its size from its edge.

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/drawn_flights.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {
namespace {

// Drawn, near-rational in coordinates of the first lattice, or grazing.
void set_query(Source& source, Case& made) {
  Random& random = source.random;
  Query& query = made.query;
  query = free_flight(random, made.scene);
  const int dimension = made.scene.dimension;
  const std::uint64_t kind = random.below(3);
  if (kind == 1) {
    made.tags.push_back("near-rational");
    const IntVec along = drawn_primitive(random, dimension, 4);
    query.v = cartesian(made.scene.lattices[random.below(made.scene.lattices.size())], along);
    query.v = scaled(query.v, random.octave(-1, 1));
    return jitter(random, query.v, dimension, 3, source.precision);
  }
  const int most_tries = kind == 2 ? 4 : 0;
  for (int tries = 0; tries < most_tries; ++tries) {
    Query moved = query;
    const auto off_edge = [&] { return drawn_off_edge(random, source.precision); };
    if (move_to_edge(off_edge, made.scene, oracle_of(made.scene), moved, source.precision)) {
      query = moved;
      return made.tags.push_back("grazing");
    }
    query.v = random.direction(dimension);
  }
  made.tags.push_back("drawn");
}

std::vector<Tag> with_kinds(std::vector<Tag> tags) {
  tags.insert(tags.end(),
              {{"drawn", "uniform free start, isotropic direction"},
               {"near-rational", "a lattice vector, to a few ulps"},
               {"grazing", "the first obstacle is passed or met within 2^-10 to 2^-50 of its edge",
                "the first obstacle is passed or met within 2^-10 to 2^-21 of its edge"}});
  return tags;
}

void make_crystal(Source& source, Case& made) {
  // Crystals take turns; in every third turn a crystal has its own size.
  const std::uint64_t turn = source.index / kCasesPerScene, which = turn % crystals().size();
  const Crystal& crystal = crystals()[which];
  made.scene = crystal.scene;
  made.tags = {std::string(crystal.name)};
  const std::uint64_t size = (turn / crystals().size() + which) % 3;
  if (size > 0)
    scale_obstacles(made.scene, size == 1 ? source.scene.between(0.1, 1.1) : source.scene.octave(-13, -3));
  set_query(source, made);
}

// The unit lattice turned by pi / 5 or pi / 7 (in space about an axis), as rounded in the catalogue.
Lattice turned(int dimension, bool fifth, int axis, double radius) {
  const double c = fifth ? 0.8090169943749475 : 0.9009688679024191,
               s = fifth ? 0.5877852522924731 : 0.4338837391175581;
  Lattice lattice = unit_scene(dimension, radius).lattices[0];
  const int a = dimension == 2 ? 0 : (axis + 1) % 3, b = dimension == 2 ? 1 : (axis + 2) % 3;
  lattice.vectors[a][a] = c, lattice.vectors[a][b] = s;
  lattice.vectors[b][a] = -s, lattice.vectors[b][b] = c;
  return lattice;
}

void make_superposition(Source& source, Case& made) {
  Random& drawn = source.scene;
  const int dimension = drawn.one_in(3) ? 3 : 2;
  const double r = drawn.octave(-13, -3);
  made.scene = unit_scene(dimension, r);
  auto& lattices = made.scene.lattices;
  Lattice other = lattices[0];
  const std::string_view kind =
      drawn_tag(drawn, made.tags, {"turned", "three-lattices", "incommensurate", "shifted"});
  if (kind == "turned") {
    const int axis = drawn.axis(3);
    other = turned(dimension, drawn.one_in(2), axis, r);
  } else if (kind == "three-lattices") {
    other = turned(dimension, false, 1, r);
    lattices.push_back(turned(dimension, true, 0, r));
  } else if (kind == "incommensurate") {
    const double spacing = drawn.between(0.6, 1.7);
    for (Vec& vector : other.vectors) vector = scaled(vector, spacing);
    other.atoms[0].radius = r * drawn.between(0.3, 3);
  } else {
    for (int i = 0; i < dimension; ++i) other.atoms[0].position[i] = drawn.uniform();
    if (drawn.one_in(2)) other.vectors[0] = scaled(other.vectors[0], 1.5);
  }
  lattices.push_back(std::move(other));
  tagged(made.tags, dimension == 3, "space");
  set_query(source, made);
  if (made.tags.back() == "drawn")  // far from the point that turned lattices share
    for (int i = 0; i < dimension; ++i) made.query.x[i] += source.random.whole(-20, 20);
}

// Semiaxes along a drawn frame, `slender` times as long as wide.
std::vector<Vec> stretched_semiaxes(Random& random, int dimension, double size, double slender) {
  const auto [a, b, c] = drawn_frame(random, random.direction(dimension), dimension);
  std::vector<Vec> semiaxes{scaled(a, size), scaled(b, size / slender)};
  if (dimension == 3) semiaxes.push_back(scaled(c, random.one_in(2) ? size : size / slender));
  return semiaxes;
}

void make_ellipsoid(Source& source, Case& made) {
  Random& drawn = source.scene;
  const int dimension = drawn.one_in(2) ? 3 : 2;
  made.scene = drawn.one_in(2) ? unit_scene(dimension, 0.1) : drawn_crystal(drawn, dimension).scene;
  tagged(made.tags, dimension == 2, "ellipse", "ellipsoid");
  const bool slender = tagged(made.tags, drawn.one_in(2), "slender");
  const double stretch = slender ? drawn.between(8, 100) : drawn.between(1.2, 4);
  const double size = drawn.one_in(3) ? drawn.octave(-12, -3) : drawn.between(0.1, 0.4);
  auto& atoms = made.scene.lattices[0].atoms;
  auto semiaxes = stretched_semiaxes(drawn, dimension, size, stretch);
  if (tagged(made.tags, drawn.one_in(3), "sheared-axes"))  // such semiaxes span an ellipsoid, too
    semiaxes[0] = plus(semiaxes[0], drawn.between(-2, 2), semiaxes[1]);
  atoms[0] = {atoms[0].position, 0, std::move(semiaxes)};
  if (tagged(made.tags, drawn.one_in(2), "mixed")) {
    const Vec middle = dimension == 2 ? Vec{0.5, 0.5} : Vec{0.5, 0.5, 0.5};
    atoms.push_back({middle, 0, stretched_semiaxes(drawn, dimension, size * 0.7, drawn.between(1, 5))});
    atoms.push_back({Vec{0.5, 0, 0}, size * 0.3, {}});
  }
  set_query(source, made);
}

}  // namespace

Family crystal_lattices() {
  std::vector<Tag> tags;
  for (const Crystal& crystal : crystals())
    tags.push_back({crystal.name, crystal.scene.lattices[0].atoms.size() == 1
                                      ? "one obstacle a cell of this lattice"
                                      : "several obstacles a cell: which of them is first"});
  return {"crystals", "Crystal lattices and motifs, at their own radii and smaller ones.",
          with_kinds(std::move(tags)), make_crystal};
}

Family superpositions() {
  return {"superpositions", "Two or three lattices at once: turned, of other spacing, or shifted.",
          with_kinds({{"turned", "turned by pi/5 or pi/7: no common period that matters"},
                      {"three-lattices", "turned by both: three searches, one first hit"},
                      {"incommensurate", "another spacing: obstacles overlap somewhere"},
                      {"shifted", "a common period, small or long"},
                      {"space", "in space, turned about an axis"}}),
          make_superposition};
}

Family ellipsoids() {
  return {"ellipsoids",
          "Ellipses and ellipsoids, tilted, up to 100 times as long as wide, alone or among others.",
          with_kinds(
              {{"ellipse", "in the plane: the nearest centre is not the nearest obstacle"},
               {"ellipsoid", "in space, long or flat"},
               {"slender", "8 to 100 times as long as wide: the metric's condition costs digits"},
               {"sheared-axes", "semiaxes given not at right angles"},
               {"mixed", "different shapes in one cell, a ball among them: times from different metrics"}}),
          make_ellipsoid};
}

}  // namespace lorentz::cases
