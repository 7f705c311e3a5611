// specks: cells, starts and velocities with components that are tiny but not zero.
//
// A component of 2^-1074 beside one of 2 vanishes when the larger is scaled to 1, and a product with it
// underflows. The result is then exact for another lattice. Along a row that a speck tilts the flight meets
// an obstacle after 10^300 cells; without the speck it never does. Across the row the speck decides nothing,
// but its reciprocal overflows. So there are square, cubic and skewed cells from 2^-400 to 2^1000 with specks
// in place of zeros, and flights along rows and across.
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"

namespace lorentz::cases {
namespace {

// Powers of two that depend on the precision.
struct SpeckRange {
  explicit SpeckRange(NumberFormat precision) : is_wide(precision == NumberFormat::binary64) {}
  const bool is_wide;
  const int least = is_wide ? -1074 : -149, next_to_least = is_wide ? 60 : 12;
  const int below = is_wide ? 400 : 60;  // specks are below 1, and below the size, by 2^-this
  const int ordinary = is_wide ? 400 : 50, largest = is_wide ? 1000 : 110;
};

// The smallest numbers, or any below 2^-400 of the size; in half of the cases with all digits.
double speck(Random& random, const SpeckRange& range, int exponent_of_size) {
  const int most = std::max(range.least, std::min(exponent_of_size - range.below, -range.below));
  const int exponent = random.one_in(2) ? random.exponent(range.least, range.least + range.next_to_least - 1)
                                        : random.exponent(range.least, most);
  return std::ldexp(random.one_in(2) ? 1 : 1 + random.uniform(), std::min(exponent, most)) * random.sign();
}

// Puts a speck in place of some of the zeros.
void add_specks(Random& random, const SpeckRange& range, Vec& a, int dimension, int exponent_of_size) {
  for (int i = 0; i < dimension; ++i)
    if (a[i] == 0 && random.one_in(2)) a[i] = speck(random, range, exponent_of_size);
}

int drawn_exponent(Random& drawn, const SpeckRange& range) {
  const std::uint64_t kind = drawn.below(3);
  if (kind == 0) return drawn.exponent(-2, 2);
  return drawn.exponent(kind == 1 ? -range.ordinary : range.ordinary,
                        kind == 1 ? range.ordinary : range.largest);
}

void make_specks(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const SpeckRange range(source.precision);
  const int dimension = drawn.one_in(3) ? 3 : 2, exponent = drawn_exponent(drawn, range);
  const double size = std::ldexp(1, exponent);
  std::array<Vec, 3> vectors{};
  const bool skewed = drawn.one_in(4);
  for (int i = 0; i < dimension; ++i) {
    vectors[i][i] = size;
    if (skewed && i > 0) vectors[i][0] = size * drawn.whole(-2, 2) / 4;
    add_specks(drawn, range, vectors[i], dimension, exponent);
  }
  made.scene = lattice_scene(dimension, vectors, size * (drawn.one_in(2) ? 0.25 : drawn.between(0.02, 0.5)));
  if (drawn.one_in(4))
    add_specks(drawn, range, made.scene.lattices[0].atoms[0].position, dimension, exponent);
  const bool row = tagged(made.tags, random.one_in(2), "row", "across");
  Vec x{}, v = random.direction(dimension);
  for (int i = 0; i < dimension; ++i) x[i] = random.whole(-4, 4) / 4;
  if (row) v = to_vec(drawn_primitive(random, dimension, random.one_in(2) ? 1 : 3));
  made.query.x = scaled(x, size);
  const int fastest = range.is_wide ? 300 : 40;
  made.query.v = scaled(v, std::ldexp(1, random.one_in(2) ? 0 : random.exponent(-fastest, fastest)));
  if (tagged(made.tags, random.one_in(3), "specks-in-the-flight", "specks-in-the-cell")) {
    add_specks(random, range, made.query.x, dimension, exponent);
    add_specks(random, range, made.query.v, dimension, std::ilogb(length(made.query.v)));
  }
}

}  // namespace

Family specks() {
  return {"specks",
          "Components down to 2^-1074 where others are large: they vanish when units change.",
          {{"row", "along a lattice row, which a speck tilts"},
           {"across", "in a drawn direction"},
           {"specks-in-the-cell", "in the lattice vectors, or the atom's position"},
           {"specks-in-the-flight", "in start and velocity, too"}},
          make_specks};
}

}  // namespace lorentz::cases
