// nearby: starts outside an obstacle, 2^-40 to 1/4 of its radius from where they enter it. With s = v . d the
// distance of the centre along the line and q half the chord, both times v, the time of entry is
// (s - q) / v^2. These two numbers are nearly equal; (d^2 - r^2) / (s + q) loses nothing. The difference
// loses a roundoff of the radius, half of what an ulp in the start may change. So only a tolerance of less
// than an ulp tells the two formulas apart.
#include <cmath>

#include <lorentz/geometry.hpp>
#include "cases/families/family_list.hpp"

namespace lorentz::cases {
namespace {

void make_nearby(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const int dimension = drawn.one_in(3) ? 3 : 2;
  made.scene = unit_scene(dimension, drawn.between(0.2, 0.5));
  if (drawn.one_in(2)) {
    made.tags.push_back("other-cell");
    made.scene.lattices[0].vectors[1][0] = drawn.between(0, 0.5);
  } else {
    made.tags.push_back("unit-cell");
  }
  const double r = made.scene.lattices[0].atoms[0].radius;
  const Vec n = random.direction(dimension), along = random.direction(dimension);
  made.query.x = scaled(n, r * (1 + random.octave(source.is_wide() ? -40 : -18, -2)));
  made.query.v = sum(scaled(n, -1), scaled(along, random.between(0, 0.8)));
}

}  // namespace

Family nearby() {
  return {"nearby",
          "Starts near the obstacle that they enter: the time is a difference that cancels.",
          {{"unit-cell", "the square or cubic lattice"}, {"other-cell", "a skewed one"}},
          make_nearby};
}

}  // namespace lorentz::cases
