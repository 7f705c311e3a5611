// grazing: lines that pass an obstacle at the distance r, exactly or nearly.
//
// With d = c - x the line meets the ball iff |v x d|^2 < r^2 v^2. For integer v and dyadic r, d both sides
// are integers over a power of two, and can be equal, or next to equal.
//
// Squares: |v| = w is an integer (Pythagorean triples; in space quaternions give an integer vector h of
// length w at a right angle to v). A dyadic d has v x d = r h (start_beside), and the line is exactly
// tangent.
//
// Near squares: v^2 = w^2 +- 1. Then v x d = r w misses tangency by r / (2 w^2), less than an ulp for
// w > 2^26.
//
// Pell: r = R 2^-m and v x d = K 2^-m h with K / R a convergent of |v| / |h|. K^2 h^2 - R^2 v^2 solves Pell's
// equation or nearly, so dist / r is 1 within about 1 / R^2: down to 2^-100, beyond twice binary64's
// precision.
//
// Then x, v or r is moved by up to 4 ulps, or x by up to 2^10. The start lies within 1.8 r of the centre, so
// that nothing is met before: the only question is whether this obstacle is met.
#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {
namespace {

// Starts and radii are multiples of 2^-this, so that they are exact.
constexpr int grazing_grid(NumberFormat precision) {
  return precision == NumberFormat::binary64 ? 40 : 22;
}

// Moves x or v by ulps, and adds the tag; in half of the cases nothing moves.
void move_off(Random& random, NumberFormat precision, int dimension, Case& made) {
  const std::uint64_t how = random.below(8);
  if (how < 4) return;
  const int i = random.axis(dimension);
  made.tags.push_back(how < 7 ? "ulps-off" : "near-graze");
  const std::int64_t ulps =
      (how < 7 ? random.integer(1, 4) : random.integer(5, 1024)) * (random.one_in(2) ? 1 : -1);
  double& component = how == 6 ? made.query.v[i] : made.query.x[i];
  component = nudged(component, ulps, std::ldexp(1, -bits_of(precision)), precision);
}

// The query that passes the obstacle of the cell 0 with v x d = turns 2^-exponent across, in one of the
// lattice's symmetries. r is at most 0.3.
void set_query(Source& source, int dimension, const IntVec& v, const IntVec& across, std::int64_t turns,
               int exponent, double r, Case& made) {
  Random& random = source.random;
  const int bits = bits_of(source.precision), longest = bits == 53 ? 60 : 20;
  std::optional<Vec> x;
  for (double along = r * random.between(0.1, 1.5); !x && along > 0; along = along > 0.01 * r ? along / 2 : 0)
    x = start_beside(v, across, turns, exponent, along, bits);
  if (!x) x = Vec{-1.5 * r, 0, 0};  // no start is exact: take any
  const Symmetry symmetry(random, dimension);
  made.query = symmetry(Query{*x, to_vec(v), {}});
  if (random.one_in(4))
    made.query.v = scaled(made.query.v, std::ldexp(1, random.exponent(-longest, longest)));
}

// Integers give the distance exactly. r is a multiple of the grid, or a few ulps from one.
void make_squares(Source& source, Case& made) {
  const bool is_wide = source.is_wide();
  const int grid = grazing_grid(source.precision), least = is_wide ? -14 : -8;
  const int dimension = source.scene.one_in(3) ? 3 : 2;
  const auto steps = static_cast<std::int64_t>(std::ldexp(
      source.scene.one_in(2) ? source.scene.between(0.05, 0.3) : source.scene.octave(least, -4), grid));
  const double r = std::ldexp(static_cast<double>(steps), -grid);
  const bool r_moved = source.scene.one_in(6);
  made.scene = unit_scene(
      dimension,
      r_moved ? moved(r, source.scene.integer(1, 4) * (source.scene.one_in(2) ? 1 : -1), source.precision)
              : r);
  if (r_moved) made.tags.push_back("ulps-off");
  Random& random = source.random;
  if (dimension == 3) {
    const Squared quadruple = drawn_quadruple(random, random.one_in(2) ? 4 : is_wide ? 60 : 20);
    set_query(source, 3, quadruple.v, quadruple.across, steps, grid, r, made);
  } else if (random.one_in(2)) {
    const Squared triple = drawn_triple(random, random.one_in(2) ? 9 : is_wide ? 2000 : 40);
    set_query(source, 2, triple.v, triple.across, steps, grid, r, made);
  } else {
    made.tags.push_back("near-square");
    const NearSquare near = drawn_near_square(random, std::int64_t{1} << (is_wide ? 27 : 13));
    set_query(source, 2, near.v, {0, 0, near.w}, steps, grid, r, made);
  }
  if (!r_moved) move_off(random, source.precision, dimension, made);
  if (made.tags.empty()) made.tags.push_back("exact-tangent");
}

// v and h belong to the scene, because r depends on them.
void make_pell(Source& source, Case& made) {
  made.tags.push_back("pell");
  Random& drawn = source.scene;
  const int dimension = drawn.one_in(3) ? 3 : 2;
  IntVec v{}, h{0, 0, 1};
  std::vector<IntegerRatio> fractions;
  const int bits = bits_of(source.precision);
  const std::size_t enough = bits == 53 ? 8 : 4;
  for (int tries = 0; tries < 16 && fractions.size() < enough; ++tries) {
    v = drawn_primitive(drawn, dimension, dimension == 2 ? 60 : 12);
    if (dimension == 3) h = across_of(v)[0];
    fractions = convergents_of_root(dot(v, v), dot(h, h), bits - 3);
  }
  const std::size_t few = fractions.size() / 4;  // the first convergents are not near
  const auto [k, r_steps] = fractions[few + drawn.below(fractions.size() - few)];
  const int exponent = std::ilogb(static_cast<double>(r_steps)) + drawn.exponent(3, 6);
  const double r = std::ldexp(static_cast<double>(r_steps), -exponent);
  made.scene = unit_scene(dimension, r);
  // A finer grid, so that there are enough starts.
  const int finer = std::max(0, (bits == 53 ? 43 : 21) - std::ilogb(static_cast<double>(r_steps)));
  set_query(source, dimension, v, h, k << finer, exponent + finer, r, made);
  move_off(source.random, source.precision, dimension, made);
}

}  // namespace

Family grazing() {
  return {
      "grazing",
      "Lines that pass an obstacle at the distance of its radius, exactly or within ulps.",
      {{"exact-tangent", "exactly tangent: the line touches, and does not hit"},
       {"near-square", "v^2 is a square plus or minus 1: tangent but for a relative 1/(2 v^2)"},
       {"pell", "radius and distance from Pell's equation: tangent but for as little as 2^-100",
        "radius and distance from Pell's equation: tangent but for as little as 2^-42"},
       {"ulps-off", "one of x, v, r up to 4 ulps from such a case"},
       {"near-graze", "x 5 to 1024 ulps from such a case"}},
      [](Source& source, Case& made) { (source.scene.one_in(3) ? make_pell : make_squares)(source, made); }};
}

}  // namespace lorentz::cases
