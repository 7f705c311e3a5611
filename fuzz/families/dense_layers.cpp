// dense-layers: lattice planes so dense that a radius spans 5 to 24 spacings, in one direction or two, with
// up to three atoms. Balls then merge into a wall (or, if one direction is dense, into corrugated rods) whose
// surface has a roughness of about s^2 / 8r, s the spacing. A flight comes down on hundreds of rows that all
// lead to nearly the same time. Which row is first depends on the slope; which atom is first depends on
// heights that differ by no more than the roughness. Searches that take rows by their order, that stop at the
// first row with a hit, or that compare the times of two atoms in different units go wrong here and nowhere
// else.
//
// Starts are a few spacings above the wall, so that a walk from cell to cell can get there, too.
//
// dense-rows: layers far apart, made of dense rows at right angles to the flight, which comes down to a layer
// at a small slope. Obstacles are about r / 80 apart within a row, rows are 1 apart, and layers are far
// enough apart for a free path of about a thousand rows. The layer's section of the cylinder begins at a tip;
// at the distance s from it, it is sqrt(2 r slope s) wide, which soon exceeds the spacing of the obstacles.
// So the first row after the tip is the one that is hit, and the search has to find it in a stretch of many
// rows. A search that takes the stretch in parts, short ones first, must leave no gap between them.
#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/scenes.hpp"

namespace lorentz::cases {
namespace {

// A wall at z = 0 of thickness 2 (its largest obstacle) and period `period`, spacings s and `other`.
struct Layers {
  double s, other, period;
  bool coarse;
};

// An obstacle whose highest point is at z = 1, up to the roughness of the wall. An ellipsoid has two semiaxes
// in the plane of the layer, and one that leads out of it.
Atom drawn_atom(Random& drawn, const Layers& layers, bool ellipsoid) {
  Atom atom;
  const double size = drawn.one_in(2) ? 1 : drawn.between(0.6, 1), rough = layers.s * layers.s;
  atom.position = {layers.s * drawn.uniform(), layers.other * drawn.uniform(),
                   1 - size + rough * drawn.between(-0.25, 0.25)};
  if (!ellipsoid) {
    atom.radius = size;
    return atom;
  }
  const Vec a = drawn.direction(2);
  const double wide = drawn.between(0.7, 1.2), narrow = wide * (drawn.one_in(2) ? 1 : drawn.between(0.6, 1));
  atom.semiaxes = {scaled(a, wide),
                   scaled({-a[1], a[0], 0}, narrow),
                   {drawn.between(-0.3, 0.3), drawn.between(-0.3, 0.3), size}};
  return atom;
}

// Rounds every number to a grid of a 16th of the spacing, which is a power of two: ties among rows and atoms.
void coarsen(Scene& scene, double s) {
  const auto round = [&](double& a) { a = std::round(a / s * 16) * (s / 16); };
  Lattice& lattice = scene.lattices[0];
  for (Vec& u : lattice.vectors)
    for (double& component : u) round(component);
  for (Atom& atom : lattice.atoms) {
    round(atom.radius);
    for (double& component : atom.position) round(component);
    for (Vec& axis : atom.semiaxes)
      for (double& component : axis) round(component);
  }
}

Layers drawn_dense_layers(Random& drawn, Case& made) {
  Layers layers{};
  const bool rods = tagged(made.tags, drawn.one_in(4), "rods", "walls");
  layers.coarse = tagged(made.tags, drawn.one_in(3), "coarse");
  const bool usual = !drawn.one_in(4);  // the cost of a walk grows with the square
  layers.s =
      layers.coarse ? (usual ? 0.125 : 0.0625) : 1 / (usual ? drawn.between(8, 14) : drawn.between(5, 24));
  layers.other = rods ? drawn.between(0.5, 1.5) : layers.s * (layers.coarse ? 1 : drawn.between(0.7, 1.5));
  layers.period = 2 + layers.s * drawn.octave(-2, 4);
  return layers;
}

Scene layered_scene(Random& drawn, const Layers& layers, Case& made) {
  Scene scene{3, {Lattice{}}};
  Lattice& lattice = scene.lattices[0];
  const double skew = drawn.one_in(4) ? 0 : drawn.one_in(2) ? 0.5 : drawn.between(-0.5, 0.5);
  lattice.vectors = {Vec{layers.s, 0, 0}, Vec{layers.s * skew, layers.other, 0},
                     Vec{layers.s * drawn.between(-1, 1), layers.other * skew, layers.period}};
  const bool ellipsoids = !drawn.one_in(3);
  const std::int64_t atoms = drawn.integer(ellipsoids ? 2 : 1, 3);
  tagged(made.tags, atoms == 1, "one-atom", "several-atoms");
  tagged(made.tags, ellipsoids, "ellipsoids");
  const std::int64_t first = drawn.one_in(4) ? 0 : 1;  // then every other one
  for (std::int64_t n = 0; n < atoms; ++n)
    lattice.atoms.push_back(drawn_atom(drawn, layers, ellipsoids && n % 2 == first));
  if (layers.coarse) coarsen(scene, layers.s);
  return scene;
}

// A velocity down onto the wall: at any slope, steeply, straight down, or with small integers.
Vec layered_velocity(Random& random, Case& made) {
  const std::string_view kind = drawn_tag(
      random, made.tags,
      {"straight", "steep", "few-bits", "few-bits", "any-slope", "any-slope", "any-slope", "any-slope"});
  if (kind == "straight") return {0, 0, -1};
  if (kind == "steep")
    return {random.octave(-40, -2) * random.sign(), random.octave(-40, -2) * random.sign(), -1};
  if (kind == "few-bits") return {random.whole(-8, 8), random.whole(-8, 8), random.whole(-8, -1)};
  Vec v = random.direction(3);
  v[2] = -std::max(std::fabs(v[2]) * random.octave(-3, 0), 0.0625);
  return v;
}

// A start on top of the first obstacle, up to rounding; the flight goes to the next layer.
void leave_layer(Random& random, const Layers& layers, Case& made) {
  const Atom& atom = made.scene.lattices[0].atoms[0];
  made.tags.push_back("leaving");
  made.query.x = sum(atom.position, semiaxes_of(atom, 3)[2]);
  made.query.v[2] = -made.query.v[2];
  made.query.from = ObstacleId{};
  if (random.one_in(3)) made.query.x[2] += layers.s * random.uniform();
}

void make_dense(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const Layers layers = drawn_dense_layers(drawn, made);
  made.scene = layered_scene(drawn, layers, made);
  made.query.v = layered_velocity(random, made);
  if (random.one_in(6)) return leave_layer(random, layers, made);
  const bool coarse = random.one_in(2);
  const auto place = [&](double across) {
    return coarse ? across * random.whole(-8, 8) / 8 : across * random.between(-1, 1);
  };
  made.query.x = {place(layers.s), place(layers.other), 1 + layers.s * random.octave(-6, 1)};
}

void make_dense_rows(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const double r = drawn.octave(-5, -3), apart = r / drawn.between(66, 95);
  const double layers = 400 * r * r / apart * drawn.octave(0, 4);
  const Symmetry symmetry(drawn, 3);
  made.scene = lattice_scene(3,
                             {symmetry(Vec{apart, 0, 0}), symmetry(Vec{apart * drawn.uniform(), 1, 0}),
                              symmetry(Vec{drawn.uniform(), drawn.uniform(), layers})},
                             r);
  const bool skew = tagged(made.tags, random.one_in(4), "skew", "straight");
  const double slope = r * random.octave(-10, -6);
  made.query =
      symmetry(Query{Vec{apart * random.uniform(), random.uniform(), -r - slope * random.between(0, 2)},
                     Vec{skew ? random.octave(-12, -4) : 0, 1, slope},
                     {}});
}

}  // namespace

Family dense_layers() {
  return {"dense-layers",
          "Layers so dense that a radius spans 5 to 24 spacings: one wall of many rows, of several atoms.",
          {{"walls", "dense in two directions"},
           {"rods", "dense in one direction, with gaps or grooves in the other"},
           {"coarse", "on a grid of a 16th of the spacing: rows and atoms that are entered together"},
           {"one-atom", "one obstacle a cell"},
           {"several-atoms", "two or three, as high as each other but for the roughness of the wall"},
           {"ellipsoids", "some of them in metrics of their own"},
           {"straight", "at right angles to the layers"},
           {"steep", "nearly so, down to 2^-40"},
           {"few-bits", "along a small integer vector"},
           {"any-slope", "isotropic, but not along the layers"},
           {"leaving", "from the top of an obstacle to the next layer"}},
          make_dense};
}

Family dense_rows() {
  return {"dense-rows",
          "Down to layers of dense rows at right angles to the flight: the first of many rows.",
          {{"straight", "at right angles"}, {"skew", "off that by 2^-12 to 2^-4"}},
          make_dense_rows};
}

}  // namespace lorentz::cases
