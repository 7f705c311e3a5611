// axis-and-diagonal: numbers that people type, and the ends of binary64's range. Directions are along axes,
// diagonals and other small integers, with zeros of either sign or components too small to matter in any cell
// that is reached. Starts are at halves, on cell edges and corners, in negative cells and beyond 2^53.
// Velocities are subnormal or near overflow, so that their squares leave the range. All numbers are exact, so
// every formula that divides by a component, takes the floor of a coordinate, or squares a velocity meets its
// worst arguments.

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {
namespace {

void set_direction(Source& source, int dimension, Case& made) {
  Random& random = source.random;
  const bool is_wide = source.is_wide();
  const double smallest = is_wide ? 0x1p-1074 : 0x1p-149;
  Vec& v = made.query.v;
  const bool axis = tagged(made.tags, random.one_in(3), "axis", "small-integers");
  v = to_vec(drawn_primitive(random, dimension, random.one_in(2) ? 1 : 6));
  const int kept = random.axis(dimension);
  if (axis)
    for (int i = 0; i < dimension; ++i) v[i] = i == kept ? random.sign() : 0.0;
  bool minus_zero = false, tiny = false;
  for (int i = 0; i < dimension; ++i) {
    if (v[i] != 0) continue;
    const std::uint64_t how = random.below(4);
    if (how == 0) v[i] = -0.0, minus_zero = true;
    if (how == 1)
      v[i] = random.sign() * (random.one_in(3) ? smallest
                              : is_wide        ? random.octave(-1022, -30)
                                               : random.octave(-126, -30)),
      tiny = true;
  }
  tagged(made.tags, minus_zero, "minus-zero");
  if (tagged(made.tags, tiny, "tiny-component") || !random.one_in(3)) return;
  const bool huge = tagged(made.tags, random.one_in(2), "huge-velocity", "subnormal-velocity");
  const double factor = !huge ? smallest : is_wide ? random.octave(900, 1020) : random.octave(100, 120);
  for (int i = 0; i < dimension; ++i)
    if (v[i] != 0) v[i] *= huge ? factor : factor * random.whole(1, 4096);
}

// A multiple of 1/2 or 1/8 in a cell near or far; in one case in four moved by up to 2 ulps.
void set_axis_start(Source& source, int dimension, const Lattice& lattice, Case& made) {
  Random& random = source.random;
  const bool is_wide = source.is_wide();
  Vec& x = made.query.x;
  const bool far = tagged(made.tags, random.one_in(4), "far-cell");
  const std::int64_t range =
      far ? std::int64_t{1} << (is_wide ? random.integer(20, 56) : random.integer(8, 26)) : 50;
  const double grid = random.one_in(2) ? 2 : 8;
  for (int i = 0; i < dimension; ++i) {
    const double share = random.whole(0, static_cast<std::int64_t>(grid));
    x = plus(x, random.whole(-range, range) + share / grid, lattice.vectors[i]);
  }
  if (tagged(made.tags, random.one_in(4), "ulps-off")) jitter(random, x, dimension, 2, source.precision);
}

void make_axis(Source& source, Case& made) {
  static constexpr double kRadii[] = {0.5, 0.25, 0.125, 0.3125, 0.1, 0.01, 0x1p-20};
  Random& drawn = source.scene;
  const int dimension = drawn.one_in(2) ? 3 : 2;
  made.scene = drawn.one_in(3) ? drawn_crystal(drawn, dimension).scene : unit_scene(dimension, 1);
  set_radius(made.scene, kRadii[drawn.below(7)]);
  set_axis_start(source, dimension, made.scene.lattices[0], made);
  set_direction(source, dimension, made);
}

}  // namespace

Family axis_and_diagonal() {
  return {
      "axis-and-diagonal",
      "Directions of zeros and small integers, starts at halves and in far cells, velocities at the ends of "
      "binary64's range.",
      {{"axis", "along an axis: slopes of 0 and infinity"},
       {"small-integers", "along a small integer vector: periodic, through corners and middles of cells"},
       {"minus-zero", "a component is -0, which is 0"},
       {"tiny-component", "a component of 2^-30 down to 2^-1074, which is not 0",
        "a component of 2^-30 down to 2^-149, which is not 0"},
       {"huge-velocity", "components beyond 1e270: their squares overflow",
        "components beyond 1e30: their squares overflow"},
       {"subnormal-velocity", "components below 1e-307: their squares vanish",
        "components below 1e-38: their squares vanish"},
       {"far-cell", "starts in cells up to 2^56: the offset in the cell keeps few bits, or none",
        "starts in cells up to 2^26: the offset in the cell keeps few bits, or none"},
       {"ulps-off", "a start moved up to 2 ulps in each component"}},
      make_axis,
      "Directions of zeros and small integers, starts at halves and in far cells, velocities at the ends of "
      "binary32's range."};
}

}  // namespace lorentz::cases
