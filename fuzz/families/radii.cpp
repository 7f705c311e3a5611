// large-radius: from touching obstacles to those that leave nearly nothing free. Above half the shortest
// vector, obstacles overlap their neighbours: the first one entered is no longer the nearest along the line,
// several contain x, and the free part is cut into pockets, until at the covering radius none is left. In
// elongated cells a radius of 50 shortest vectors is still sparse in one direction: rows merge into walls
// with corridors between them. Radii come within ulps of touching, and within 2^-40 of covering.
//
// tiny-radius: flights of 1 / 2r cells (2D) or 1 / (pi r^2) (3D) among obstacles of the size of the
// coordinates' last bits.
//
// unequal-radii: balls of one lattice in space whose radii differ by 2^3 to 2^6. The free paths differ by the
// square of that, and a basis that is short for a window of one length is long for a window of the other. An
// engine that prepares a direction for one atom and continues from there for the next has to change the scale
// along the flight, too.
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/drawn_flights.hpp"
#include "question/cases/scenes.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {
namespace {

// A start near the hole between obstacles, at most `room` away from it, or anywhere in the cell.
Vec drawn_start(Random& random, const Scene& scene, const Vec& hole, double room) {
  if (random.one_in(8)) return point_in_cell(random, scene);
  Vec x = sum(hole, random.vector(scene.dimension, room * random.uniform()));
  for (int i = 0; i < scene.dimension; ++i) x = plus(x, random.whole(-2, 2), scene.lattices[0].vectors[i]);
  return x;
}

void make_large(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const int dimension = drawn.one_in(2) ? 3 : 2;
  const double covering = std::sqrt(dimension) / 2;
  const bool is_wide = source.is_wide();
  double r = 0.5, period = 1;  // of the second vector
  const std::string_view size =
      drawn_tag(drawn, made.tags, {"touching", "overlapping", "pocket", "covering", "elongated"});
  if (size == "touching") {
    r = drawn.one_in(2) ? moved(0.5, drawn.integer(-3, 3), source.precision)
                        : 0.5 * (1 + drawn.octave(is_wide ? -40 : -20, -4) * drawn.sign());
  } else if (size == "overlapping") {
    r = drawn.between(0.5, dimension == 2 ? 0.6 : std::sqrt(0.5));
  } else if (size == "pocket") {
    r = covering * (1 - drawn.octave(-20, -3));
  } else if (size == "covering") {
    r = drawn.one_in(2) ? moved(covering, drawn.integer(-4, 4), source.precision)
        : is_wide       ? covering * (1 - drawn.octave(-41, -30))
                        : covering * (1 - drawn.octave(-20, -14));
  } else {
    r = dimension == 2 ? drawn.octave(1, 5) * 1.5 : drawn.octave(0, 2);
    period = 2 * r * (1 + drawn.octave(-12, 0));
  }
  made.scene = unit_scene(dimension, r);
  made.scene.lattices[0].vectors[1][1] = period;
  const double room = period > 1 ? (period - 2 * r) / 2 : std::max(covering - r, is_wide ? 0x1p-50 : 0x1p-21);
  made.query.x = drawn_start(random, made.scene, {0.5, period / 2, dimension == 2 ? 0 : 0.5}, room);
  made.query.v = random.one_in(2) ? random.direction(dimension)
                                  : near_integer_direction(random, dimension, source.precision);
}

void make_tiny(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const int dimension = drawn.one_in(2) ? 3 : 2;
  tagged(made.tags, dimension == 2, "tiny-2d", "tiny-3d");
  const bool is_wide = source.is_wide();
  double r = dimension == 2 ? (is_wide ? drawn.octave(-39, -20) : drawn.octave(-19, -10))
                            : (is_wide ? drawn.octave(-23, -10) : drawn.octave(-13, -6));
  made.scene = unit_scene(dimension, r);
  if (tagged(made.tags, drawn.one_in(2), "scaled-cell")) {
    auto& vectors = made.scene.lattices[0].vectors;
    const double size = drawn.octave(-30, 30);
    for (int i = 0; i < dimension; ++i)
      for (int k = 0; k < dimension; ++k)
        vectors[i][k] = size * ((i == k) + (k < i ? drawn.between(-0.5, 0.5) : 0));
    set_radius(made.scene, r * size);
  }
  made.query.x = point_in_cell(random, made.scene);
  made.query.v = random.direction(dimension);
  if (tagged(made.tags, random.one_in(4), "slow"))
    made.query.v = near_integer_direction(random, dimension, source.precision);
}

void make_unequal(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  made.scene = drawn.one_in(2) ? unit_scene(3, 1) : drawn_crystal(drawn, 3).scene;
  Lattice& lattice = made.scene.lattices[0];
  const double small = drawn.octave(-12, -9), large = small * drawn.octave(3, 6);
  const bool small_first = tagged(made.tags, drawn.one_in(2), "small-first", "large-first");
  lattice.atoms = {{{}, small_first ? small : large, {}}, {{}, small_first ? large : small, {}}};
  for (double& component : lattice.atoms[1].position) component = drawn.between(0.2, 0.8);
  made.query = free_flight(random, made.scene);
}

}  // namespace

Family large_radius() {
  return {
      "large-radius",
      "Obstacles that touch, overlap, enclose pockets or leave nearly nothing free.",
      {{"touching", "radius within ulps of half the lattice constant: gaps of an ulp, or none"},
       {"overlapping", "neighbours overlap: the nearest centre is not the first entry"},
       {"pocket", "free pockets closed on all sides: no flight leaves its cell"},
       {"covering", "radius within 2^-30 of the covering radius: pockets of 10^-9, or none",
        "radius within 2^-14 of the covering radius: pockets of 10^-4, or none"},
       {"elongated", "radius of up to 50 shortest vectors: rows merge into walls, dozens contain a point"}},
      make_large};
}

Family tiny_radius() {
  return {"tiny-radius",
          "Radii down to 1e-12 of the lattice constant in the plane, 1e-7 in space.",
          {{"tiny-2d", "flights of 10^6 to 10^12 cells in the plane",
            "flights of 10^3 to 10^6 cells in the plane"},
           {"tiny-3d", "flights of 10^6 to 10^13 cells in space", "flights of 10^3 to 10^7 cells in space"},
           {"scaled-cell", "cells of 10^-9 to 10^9, skewed: absolute tolerances show"},
           {"slow", "directions ulps from small integers: flights of 10^15 and more, or none",
            "directions ulps from small integers: flights of 10^6 and more, or none"}},
          make_tiny,
          "Radii down to 1e-6 of the lattice constant in the plane, 1e-4 in space."};
}

Family unequal_radii() {
  return {"unequal-radii",
          "Two balls a cell in space, one 2^3 to 2^6 times as large as the other.",
          {{"small-first", "the first atom is the smaller one"}, {"large-first", "the larger one"}},
          make_unequal};
}

}  // namespace lorentz::cases
