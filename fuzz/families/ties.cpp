// ties: two obstacles entered at the same time, exactly or within ulps. The answer is then the smallest
// (lattice, atom, cell), or depends on the last bit of the difference of two square roots.
//
// Exact ties are obstacles that are mirror images in the line of flight (or, in space, in a plane that
// contains it, or are turned into each other about the diagonal); two balls with a common surface point that
// the line goes through, made of Pythagorean triples; and the same obstacle written twice, as two atoms or in
// two lattices, also in another basis, so that its cells have other numbers. Then the start or the velocity
// is moved by a few ulps.
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/drawn_flights.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {
namespace {

double dyadic(Random& random, int low, int high) {  // eighths of a power of two: few bits
  const int exponent = random.exponent(low, high) - 3;
  return std::ldexp(random.whole(8, 15), exponent);
}

// A start at a multiple of 2^-40 (in binary32 2^-20) along the line behind the origin, so that it is exact.
double behind(Random& random, NumberFormat precision) {
  const int grid = precision == NumberFormat::binary64 ? 40 : 20;
  return std::ldexp(random.whole(1l << (grid - 2), 1l << (grid - 1)), -grid);
}

// Atoms that are mirror images in the line of flight, which runs along the first axis or the diagonal.
void make_mirrored(Source& source, int dimension, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  made.tags.push_back("mirrored");
  const double r = dyadic(drawn, -4, -3), off = r * dyadic(drawn, -3, -2) * 1.5,
               ahead = drawn.one_in(2) ? 0.25 : 0.0;
  const bool diagonal = drawn.one_in(2);
  const double s = behind(random, source.precision);
  made.scene = unit_scene(dimension, r);
  auto& atoms = made.scene.lattices[0].atoms;
  if (diagonal && dimension == 3) {
    atoms = {ball({off, ahead, 0}, r), ball({0, off, ahead}, r), ball({ahead, 0, off}, r)};
    made.query = {{-s, -s, -s}, {1, 1, 1}, {}};
  } else if (diagonal) {
    atoms = {ball({ahead + off, ahead}, r), ball({ahead, ahead + off}, r)};
    made.query = {{-s, -s}, {1, 1}, {}};
  } else {
    atoms = {ball({ahead, off}, r), ball({ahead, -off}, r)};
    if (dimension == 3 && drawn.one_in(2))
      atoms.insert(atoms.end(), {ball({ahead, 0, off}, r), ball({ahead, 0, -off}, r)});
    made.query = {{-s, 0}, {1, 0}, {}};
  }
}

// Two balls through the origin, with centres at triples; any line through it into both enters both there.
void make_shared_point(Source& source, int dimension, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  made.tags.push_back("shared-point");
  made.scene = unit_scene(dimension, 1);
  auto& atoms = made.scene.lattices[0].atoms;
  atoms.clear();
  IntVec first{};
  for (int i = 0; i < 2; ++i) {
    Squared one = dimension == 2 ? drawn_triple(drawn, 9) : drawn_quadruple(drawn, 3);
    if (i == 0) first = one.v;
    if (dot(one.v, first) < 0)  // both on the same side
      for (std::int64_t& component : one.v) component = -component;
    const int exponent = -std::ilogb(static_cast<double>(one.length)) - drawn.exponent(3, 5);
    atoms.push_back(ball(scaled(to_vec(one.v), std::ldexp(1, exponent)),
                         std::ldexp(static_cast<double>(one.length), exponent)));
  }
  // x is a multiple of v and must be exact: the bits of both factors fit into one significand.
  const bool is_wide = source.is_wide();
  const int velocity_bits = is_wide ? 20 : 12, multiple_bits = is_wide ? 16 : 12;
  const Vec middle = sum(atoms[0].position, atoms[1].position);
  for (int i = 0; i < dimension; ++i)
    made.query.v[i] = std::round(std::ldexp(middle[i] * random.between(0.5, 1.5), velocity_bits));
  const double far = std::ldexp(random.whole(1, 1 << multiple_bits), -velocity_bits - multiple_bits - 1);
  for (int i = 0; i < dimension; ++i) made.query.x[i] = made.query.v[i] == 0 ? 0.0 : -far * made.query.v[i];
}

// The same obstacles twice: as two atoms, in two lattices, or in two lattices with different bases.
void make_twice(Source& source, int dimension, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  made.scene = unit_scene(dimension, drawn.one_in(2) ? dyadic(drawn, -8, -3) : drawn.octave(-12, -2));
  Lattice& lattice = made.scene.lattices[0];
  const std::uint64_t how = drawn.below(3);
  if (tagged(made.tags, how == 0, "identical-atoms", "superposed")) {
    lattice.atoms.push_back(lattice.atoms[0]);
  } else {
    Lattice other = lattice;
    if (how == 2) {
      other.vectors[0] = sum(other.vectors[0], other.vectors[1]);
      std::swap(other.vectors[0], other.vectors[1]);
      other.atoms[0].position[0] = drawn.whole(-2, 2);
    }
    made.scene.lattices.push_back(other);
  }
  made.query = free_flight(random, made.scene);
}

// Neighbours that overlap, entered where they meet: along the middle line between two rows.
void make_neighbours(Source& source, int dimension, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  made.tags.emplace_back("overlapping-neighbours");
  made.scene = unit_scene(dimension, drawn.between(0.5, 0.55));
  Vec x{-0.5 + std::ldexp(random.whole(-1000, 1000), -17), 0.5, 0};
  if (dimension == 3) x[2] = random.one_in(2) ? 0.0 : std::ldexp(random.whole(-1000, 1000), -14);
  made.query = Symmetry(random, dimension)(Query{x, {1, 0, 0}, {}});
}

void make_tie(Source& source, Case& made) {
  static constexpr void (*kKinds[])(Source&, int, Case&) = {make_mirrored, make_shared_point, make_twice,
                                                            make_neighbours};
  const int dimension = source.scene.one_in(3) ? 3 : 2;
  kKinds[source.scene.below(4)](source, dimension, made);
  Random& random = source.random;
  // Multiplied by a number of few bits, so that an exact tie stays exact.
  made.query.v = scaled(made.query.v, std::ldexp(random.whole(1, 4095), -12));
  if (!tagged(made.tags, random.one_in(3), "within-ulps")) return;
  const double unit = std::ldexp(1, -54 + missing_bits(source.precision));
  Vec& moved_one = random.one_in(2) ? made.query.x : made.query.v;
  for (int i = 0; i < dimension; ++i)
    moved_one[i] = nudged(moved_one[i], random.integer(-4, 4), unit, source.precision);
}

}  // namespace

Family ties() {
  return {
      "ties",
      "Two obstacles or more entered at the same time, exactly or within ulps.",
      {{"mirrored", "obstacles symmetric about the line of flight"},
       {"shared-point", "two spheres of different size through one point, entered there"},
       {"identical-atoms", "one obstacle written twice in the motif: the first of them is the answer"},
       {"superposed", "one lattice written twice, also in another basis and cell: the first is the answer"},
       {"overlapping-neighbours", "obstacles of two neighbouring cells, entered where they meet"},
       {"within-ulps", "x or v a few ulps off: the tie broken by some 2^-54",
        "x or v a few ulps off: the tie broken by some 2^-25"}},
      make_tie};
}

}  // namespace lorentz::cases
