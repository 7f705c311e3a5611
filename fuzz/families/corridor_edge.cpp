// corridor-edge: starts on the edge of a corridor, or ulps from it, along its axis or ulps off it.
//
// Rows of obstacles along the lattice vector g are area / |g| apart. A line parallel to g at the distance y
// from a row meets none of its obstacles iff y >= r. On the edge, y = r, it is tangent to every one and flies
// for ever; an ulp below the edge it hits. An ulp off the axis the hit comes after about 10^15 cells. In the
// square lattice the edge of g is exact in binary64 where |g| is an integer: along the axes, and for
// Pythagorean triples. In space the channel between planes with the indices n (|n| an integer) takes the
// corridor's place. Elsewhere the nearest binary64 start stands for the edge.
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {
namespace {

// Exact starts and radii are multiples of 2^-this.
constexpr int edge_grid(NumberFormat precision) {
  return precision == NumberFormat::binary64 ? 40 : 18;
}

// A radius below the half width, or within ulps of it; on the grid if `exact` and not within ulps.
double drawn_radius(Random& random, NumberFormat precision, double closing, bool exact,
                    std::vector<std::string>& tags) {
  if (random.one_in(3)) {
    tags.push_back("closing");
    return moved(closing, random.one_in(3) ? 0 : drawn_ulps(random), precision);
  }
  const double r = closing * random.between(0.05, 0.95);
  const int grid = edge_grid(precision);
  return exact ? std::ldexp(std::floor(std::ldexp(r, grid)), -grid) : r;
}

bool on_grid(double r, NumberFormat precision) {
  const double steps = std::ldexp(r, edge_grid(precision));
  return steps == std::floor(steps);
}

// Sets v parallel to the axis, or ulps off it; off the axis a zero component becomes a few ulps of the
// length.
void set_corridor_direction(Source& source, Vec v, int dimension, Case& made) {
  Random& random = source.random;
  const int most = source.is_wide() ? 1000 : 30;
  const double factor = random.whole(1, most) * random.sign();
  for (int i = 0; i < dimension; ++i) v[i] = v[i] == 0 ? 0.0 : v[i] * factor;
  if (tagged(made.tags, random.one_in(2), "off-axis", "along")) {
    const int i = random.axis(dimension);
    const double ulps = random.whole(1, 4) * random.sign();
    v[i] = v[i] == 0 ? std::ldexp(ulps * length(v), 1 - bits_of(source.precision))
                     : moved(v[i], static_cast<std::int64_t>(ulps), source.precision);
  }
  made.query.v = v;
}

// Moves a start off the edge in one component, or leaves it on the edge.
void move_off_edge(Source& source, bool exact, int dimension, Case& made) {
  Random& random = source.random;
  const bool off = random.below(3) > 0;
  tagged(made.tags, exact && !off, "on-edge", "near-edge");
  if (!off) return;
  const int i = random.axis(dimension);
  double& component = made.query.x[i];
  component =
      nudged(component, drawn_ulps(random), std::ldexp(1, -bits_of(source.precision)), source.precision);
}

void make_square(Source& source, Case& made) {
  const bool axis = source.scene.one_in(3);
  const Squared triple = drawn_triple(source.scene, source.scene.one_in(2) ? 3 : 9);
  const IntVec g = axis ? IntVec{1, 0, 0} : triple.v;
  const std::int64_t w = axis ? 1 : triple.length;
  const double r =
      drawn_radius(source.scene, source.precision, 0.5 / static_cast<double>(w), true, made.tags);
  made.scene = unit_scene(2, r);
  Random& random = source.random;
  const int grid = edge_grid(source.precision);
  const auto turns = static_cast<std::int64_t>(std::ldexp(r, grid)) * w;
  const auto x = start_beside(g, {0, 0, 1}, turns, grid, random.between(-9, 9), bits_of(source.precision));
  const Symmetry symmetry(random, 2);
  made.query.x = symmetry(*x);
  set_corridor_direction(source, symmetry(to_vec(g)), 2, made);
  move_off_edge(source, on_grid(r, source.precision), 2, made);
}

void make_lattice(Source& source, Case& made) {
  made.scene = source.scene.one_in(3) ? unit_scene(2, 1) : drawn_crystal(source.scene, 2).scene;
  const Lattice& lattice = made.scene.lattices[0];
  const IntVec g = drawn_primitive(source.scene, 2, 5), u = bezout(g);
  const double half = half_width(lattice, 2, g);
  set_radius(made.scene, drawn_radius(source.scene, source.precision, half, false, made.tags));
  Random& random = source.random;
  const double height = lattice.atoms[0].radius / (2 * half);  // the edge, in distances of rows
  const double across = height * random.sign(), along = random.between(-2, 2);
  made.query.x =
      sum(scaled(cartesian(lattice, g), along), scaled(cartesian(lattice, {-u[1], u[0], 0}), across));
  set_corridor_direction(source, cartesian(lattice, g), 2, made);
  move_off_edge(source, false, 2, made);
}

void make_planar(Source& source, Case& made) {
  static constexpr struct {
    IntVec n;
    int length;
  } kNormals[] = {{{1, 0, 0}, 1}, {{0, 3, 4}, 5}, {{1, 2, 2}, 3}, {{2, 3, 6}, 7}, {{1, 4, 8}, 9}};
  made.tags.push_back("planar-channel");
  const auto& [n, w] = kNormals[source.scene.below(5)];
  const auto [g1, g2] = across_of(n);
  const double r = drawn_radius(source.scene, source.precision, 0.5 / w, true, made.tags);
  made.scene = unit_scene(3, r);
  // n . x = r |n| exactly: x = s_1 g_1 + s_2 g_2 + r |n| u with n . u = 1, all on the grid.
  Random& random = source.random;
  const int grid = edge_grid(source.precision), bits = source.is_wide() ? 20 : 12;
  const std::int64_t s1 = random.integer(-(1l << grid), 1l << grid),
                     s2 = random.integer(-(1l << grid), 1l << grid),
                     off = static_cast<std::int64_t>(std::ldexp(r, grid)) * w;
  const IntVec u = bezout(n);
  const std::int64_t a = random.integer(-(1 << bits), 1 << bits), b = random.integer(1, 1 << bits);
  Vec x{}, v{};
  for (int i = 0; i < 3; ++i) {
    x[i] = std::ldexp(static_cast<double>(s1 * g1[i] + s2 * g2[i] + off * u[i]), -grid);
    v[i] = static_cast<double>(a * g1[i] + b * g2[i]);
  }
  const Symmetry symmetry(random, 3);
  made.query.x = symmetry(x);
  set_corridor_direction(source, symmetry(v), 3, made);
  move_off_edge(source, on_grid(r, source.precision), 3, made);
}

}  // namespace

Family corridor_edge() {
  return {"corridor-edge",
          "Starts on or ulps from the edge of a corridor or planar channel, along its axis or ulps off it.",
          {{"on-edge", "exactly on the edge: the line is tangent to every obstacle of a row, and hits none"},
           {"near-edge", "within 2^10 ulps of the edge, on either side: never, or a grazing hit"},
           {"along", "v as nearly along the axis as binary64 has it",
            "v as nearly along the axis as binary32 has it"},
           {"off-axis", "v a few ulps off the axis: the corridor is left after some 10^15 cells",
            "v a few ulps off the axis: the corridor is left after some 10^6 cells"},
           {"closing", "the radius is within 2^10 ulps of half the corridor's width"},
           {"planar-channel", "the same beside lattice planes, in space"}},
          [](Source& source, Case& made) {
            const std::uint64_t kind = source.scene.below(4);
            (kind == 0 ? make_planar : kind == 1 ? make_lattice : make_square)(source, made);
          }};
}

}  // namespace lorentz::cases
