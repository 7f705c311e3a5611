// far-starts: starts up to 2^50 cells away beside obstacles that nearly touch, in cells whose vectors have 53
// bits.
//
// An engine takes a start to its home cell, x - U n with n the nearest integers to U^-1 x. If x is far and
// the numbers of U have many bits, n itself is off in the last bits of the quotient: near the boundary
// between two cells, by a whole cell. If the obstacles nearly touch, the start may then lie in an obstacle of
// the neighbouring cell. So radii are within 2^-1 to 2^-40 of half the cell. Starts are midway between two
// neighbours, or on an obstacle's edge towards the next; the other coordinates are exactly or nearly those of
// a row of centres. In three cases of four the start is just far enough out for a quotient to err by about
// the gap between the obstacles.
#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"

namespace lorentz::cases {
namespace {

// A row of cubes or boxes, or a crystal, of any size.
Scene far_scene(Random& drawn, NumberFormat precision, std::vector<std::string>& tags) {
  const int least = precision == NumberFormat::binary64 ? -40 : -16;
  const int dimension = drawn.one_in(3) ? 2 : 3;
  const double size = drawn.one_in(2) ? drawn.between(0.5, 2) : drawn.octave(-20, 20);
  const bool box = tagged(tags, !drawn.one_in(4), "box", "crystal");
  if (!box) {
    Scene scene = drawn_crystal(drawn, dimension).scene;
    scale_places(scene, size);
    scale_obstacles(
        scene, size * (drawn.one_in(2) ? 1.25 * (1 - drawn.octave(least, -8)) : drawn.between(0.9, 1.25)));
    return scene;
  }
  std::array<Vec, 3> vectors{};
  for (int i = 0; i < dimension; ++i)
    vectors[i][i] = i == 0 || drawn.one_in(2) ? size : size * drawn.between(1, 2);
  const double gap = drawn.one_in(3) ? drawn.octave(least, -1) : drawn.octave(-9, -8);
  return lattice_scene(dimension, vectors, size / 2 * (1 - gap));
}

// The share of the way between the centres of two neighbours along a vector that lies outside both; at most
// 1/2.
double gap_along(const Vec& u, const Atom& atom) {
  return atom.is_ball() ? std::clamp(1 - 2 * atom.radius / length(u), 0x1p-40, 0.5) : 0x1p-8;
}

// At 2^this many cells a quotient of 53 bits (or 24) errs by about the gap.
int matching_distance(double gap, NumberFormat precision) {
  return std::clamp(bits_of(precision) + std::ilogb(gap), 4, precision == NumberFormat::binary64 ? 44 : 18);
}

// A cell up to 2^this many cells out along one vector; in every third case along all of them.
IntVec drawn_cell(Random& random, int dimension, int along, int bits, std::vector<std::string>& tags) {
  const auto size = std::int64_t{1} << bits;
  IntVec cell{};
  const bool all = tagged(tags, random.one_in(3), "anywhere", "along-a-row");
  for (int i = 0; i < dimension; ++i)
    cell[i] = all || i == along ? random.integer(-size, size) : random.integer(-6, 6);
  return cell;
}

void make_far_start(Source& source, Case& made) {
  Random& random = source.random;
  made.scene = far_scene(source.scene, source.precision, made.tags);
  const int dimension = made.scene.dimension;
  const Lattice& lattice = made.scene.lattices[0];
  const int along = random.axis(dimension);
  const Atom& atom = lattice.atoms[random.below(lattice.atoms.size())];
  const Vec& u = lattice.vectors[along];
  const double gap = gap_along(u, atom);
  const bool is_wide = source.is_wide();
  const bool matching = tagged(made.tags, !random.one_in(4), "matching");
  const int bits = matching  ? matching_distance(gap, source.precision) + random.exponent(-1, 0)
                   : is_wide ? random.exponent(10, 50)
                             : random.exponent(4, 20);
  const IntVec cell = drawn_cell(random, dimension, along, bits, made.tags);
  const bool midway = tagged(made.tags, !random.one_in(4) || !atom.is_ball(), "midway", "edge");
  const double off = random.one_in(4)   ? 0
                     : random.one_in(4) ? random.octave(is_wide ? -40 : -16, -6)
                                        : random.between(gap, 2 * gap);
  const double arm = (midway ? 0.5 : atom.radius / length(u)) * (1 + off * random.sign());
  made.query.x = sum(sum(atom.position, cartesian(lattice, cell)), scaled(u, arm * random.sign()));
  if (random.one_in(4))
    for (int i = 0; i < dimension; ++i)
      made.query.x[i] += random.octave(is_wide ? -30 : -16, -8) * length(u) * random.sign();
  made.query.v = random.direction(dimension);
}

}  // namespace

Family far_starts() {
  return {"far-starts",
          "Starts 2^10 to 2^50 cells away, between obstacles that nearly touch.",
          {{"box", "square, cubic or orthogonal cells of a size of 53 bits"},
           {"crystal", "another lattice, or several obstacles a cell, of such a size"},
           {"along-a-row", "far away along one lattice vector, near the origin along the others"},
           {"anywhere", "far away along all of them"},
           {"matching", "so far that a quotient of 53 bits errs by about the gap between two obstacles"},
           {"midway", "where two cells meet, to 2^-40 or nearer"},
           {"edge", "at the edge of an obstacle towards the next, to 2^-40 or nearer"}},
          make_far_start};
}

}  // namespace lorentz::cases
