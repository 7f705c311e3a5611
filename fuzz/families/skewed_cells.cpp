// skewed-cells: the square and cubic lattice and boxes in a skewed basis, flights off an obstacle many cells
// out.
//
// With a an integer, (1 + a^2, a) and (a, 1) are another basis of the square lattice: their determinant is 1.
// In this basis the obstacle at the integers c has the cell numbers (c_0 - a c_1, (1 + a^2) c_1 - a c_0). On
// the way back to the obstacle's position an engine meets products of the size a^4 |c|, of more than 64 bits,
// of which all but |c| cancels. An engine that gives up there forgets `from`: it answers `inside` the
// obstacle that the particle leaves, or hits it at once.
#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"

namespace lorentz::cases {
namespace {

// The edges of the cells as they look, and the basis that shears two of them.
struct Skewed {
  std::array<Vec, 3> edges{};
  int i = 0, j = 1;
  std::int64_t a = 0;
};

Skewed drawn_skewed(Random& drawn, int dimension, std::vector<std::string>& tags) {
  Skewed cells;
  const double size = drawn.one_in(2) ? 1 : std::ldexp(1, drawn.exponent(-20, 20));
  const bool box = tagged(tags, drawn.one_in(3), "box", "cube");
  for (int k = 0; k < dimension; ++k) cells.edges[k][k] = size * (box ? drawn.whole(4, 8) / 4 : 1);
  if (dimension == 3) cells.i = drawn.axis(3), cells.j = (cells.i + 1) % 3;
  cells.a = (std::int64_t{1} << drawn.integer(1, 10)) + drawn.integer(-1, 1);
  if (drawn.one_in(2)) cells.a = -cells.a;
  return cells;
}

Scene skewed_scene(Random& drawn, int dimension, const Skewed& cells) {
  std::array<Vec, 3> vectors = cells.edges;
  const auto a = static_cast<double>(cells.a);
  const Vec &e = cells.edges[cells.i], &f = cells.edges[cells.j];
  vectors[cells.i] = sum(scaled(e, 1 + a * a), scaled(f, a));
  vectors[cells.j] = sum(scaled(e, a), f);
  const double part = drawn.one_in(3) ? drawn.octave(-8, -2) : drawn.between(0.1, 0.5);
  return lattice_scene(dimension, vectors, part * std::max(length(e), length(f)));
}

// The obstacle at these edges, with its cell in the skewed basis.
ObstacleId named(const Skewed& cells, const IntVec& c) {
  IntVec cell = c;
  cell[cells.i] = c[cells.i] - cells.a * c[cells.j];
  cell[cells.j] = (1 + cells.a * cells.a) * c[cells.j] - cells.a * c[cells.i];
  return obstacle(cell);
}

void make_skewed_cells(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const int dimension = drawn.one_in(2) ? 3 : 2;
  const Skewed cells = drawn_skewed(drawn, dimension, made.tags);
  made.scene = skewed_scene(drawn, dimension, cells);
  const double radius = made.scene.lattices[0].atoms[0].radius;
  const bool far = tagged(made.tags, random.one_in(2), "far", "near");
  const auto range = std::int64_t{1} << (!far               ? random.integer(0, 8)
                                         : source.is_wide() ? random.integer(20, 40)
                                                            : random.integer(9, 16));
  const IntVec c = drawn_integers(random, dimension, range);
  Vec centre{};
  for (int k = 0; k < dimension; ++k) centre = plus(centre, static_cast<double>(c[k]), cells.edges[k]);
  const Vec n = random.direction(dimension);
  const bool inside = tagged(made.tags, random.one_in(4), "inside", "surface");
  made.query.x = plus(centre, inside ? radius * random.uniform() : radius, n);
  made.query.v = random.direction(dimension);
  if (lorentz::dot(made.query.v, n) < 0) made.query.v = scaled(made.query.v, -1);
  made.query.from = named(cells, c);
}

}  // namespace

Family skewed_cells() {
  return {"skewed-cells",
          "Flights off an obstacle many cells out, in a basis so skewed that its cell has large numbers.",
          {{"cube", "the square or cubic lattice"},
           {"box", "rectangular cells"},
           {"near", "up to 2^8 cells out"},
           {"far", "up to 2^20 to 2^40 cells out"},
           {"surface", "from the surface, but for rounding"},
           {"inside", "from within the obstacle that is left"}},
          make_skewed_cells};
}

}  // namespace lorentz::cases
