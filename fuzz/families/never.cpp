// never: flights that never hit anything, and flights beside them that do.
//
// All inputs are rational, so a line is periodic modulo each lattice. It misses everything only if v is
// parallel to a lattice vector (a lattice plane) and x lies in a channel: a corridor, a layer between planes,
// or a hole through overlapping spheres. Several atoms, several lattices or ellipses can leave each of these
// open in common. A program has to know that; it cannot find out by flying. The lattices have few bits, so
// that v is parallel exactly. A change of v by an ulp then makes the flight a hit, in most cases after 10^15
// cells. (Starts beside the edge belong to corridor-edge.)
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {
namespace {

double sixty_fourths(Random& random, std::int64_t low, std::int64_t high) {
  return random.whole(low, high) / 64;
}

// Between low and high; in one case in four close to low.
double within(Random& random, NumberFormat precision, double low, double high) {
  const int least = precision == NumberFormat::binary64 ? -40 : -16;
  if (random.one_in(4)) return low + (high - low) * random.octave(least, -4);
  return random.between(low, high);
}

void corridor(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  std::array<Vec, 3> vectors{Vec{1, 0}, Vec{0, 1}, Vec{}};
  if (drawn.one_in(2))
    vectors = {Vec{sixty_fourths(drawn, 48, 99), 0},
               Vec{sixty_fourths(drawn, 0, 32), sixty_fourths(drawn, 48, 150)}, Vec{}};
  made.scene = lattice_scene(2, vectors, 1);
  const Lattice& lattice = made.scene.lattices[0];
  const IntVec g = drawn_primitive(drawn, 2, 5), u = bezout(g);
  const double half = half_width(lattice, 2, g);
  set_radius(made.scene, half * drawn.between(0.01, 0.98));
  const double edge = lattice.atoms[0].radius / (2 * half);  // in distances of rows
  const double rows = random.whole(-3, 3) + within(random, source.precision, edge, 1 - edge);
  made.query = {sum(scaled(cartesian(lattice, g), random.between(-2, 2)),
                    scaled(cartesian(lattice, {-u[1], u[0], 0}), rows)),
                cartesian(lattice, g),
                {}};
}

void plane(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const IntVec n = drawn_primitive(drawn, 3, 2);
  const double size = length(to_vec(n)), r = drawn.between(0.01, 0.98) / (2 * size);
  made.scene = unit_scene(3, r);
  const auto [g1, g2] = across_of(n);
  const Vec u = to_vec(bezout(n));
  const double upwards = within(random, source.precision, r * size, 1 - r * size);
  const double along_2 = random.between(-2, 2), along_1 = random.between(-2, 2);
  made.query.x = sum(sum(scaled(to_vec(g1), along_1), scaled(to_vec(g2), along_2)), scaled(u, upwards));
  const std::int64_t most = random.one_in(2) ? 5 : std::int64_t{1} << (source.is_wide() ? 30 : 12);
  const double a = random.whole(-most, most), b = random.whole(1, most);
  made.query.v = sum(scaled(to_vec(g1), a), scaled(to_vec(g2), b));
}

void cylinder(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const double r = drawn.between(0.5, 0.7), room = std::sqrt(0.5) - r;
  made.scene = unit_scene(3, r);
  const Vec off = random.vector(2, room * (random.one_in(4) ? 0.999 : random.uniform()));
  made.query = {{random.between(-2, 2), 0.5 + off[0], 0.5 + off[1]}, {1, 0, 0}, {}};
}

// Rows of two kinds of obstacles along the first axis.
void motif(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const double y = sixty_fourths(drawn, 24, 40), r = drawn.between(0.01, 0.15),
               other = drawn.between(0.01, 0.2);
  made.scene = unit_scene(2, r);
  made.scene.lattices[0].atoms.push_back({{drawn.uniform(), y}, other, {}});
  made.query = {{random.between(-2, 2), within(random, source.precision, r, y - other)}, {1, 0}, {}};
}

// Two lattices whose rows along the first axis coincide, or are midway between each other's.
void superposition(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const double r = drawn.between(0.01, 0.2), other = drawn.between(0.01, 0.2);
  made.scene = unit_scene(2, r);
  Lattice second = made.scene.lattices[0];
  second.vectors = {Vec{drawn.between(0.6, 1.7), 0}, Vec{drawn.uniform(), drawn.one_in(2) ? 1.0 : 0.5},
                    Vec{}};
  second.atoms = {{{drawn.uniform(), 0}, other, {}}};
  made.scene.lattices.push_back(second);
  made.query = {
      {random.between(-2, 2), within(random, source.precision, std::max(r, other), 0.5 - other)}, {1, 0}, {}};
}

// An ellipse { A y : |y| < 1 } reaches as high as the length of the second row of A.
void ellipse(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  made.scene = unit_scene(2, 1);
  const double size = drawn.between(0.05, 0.45), thin = size / drawn.between(1, 20);
  const Vec a = drawn.direction(2);
  made.scene.lattices[0].atoms[0] = {{}, 0, {scaled(a, size), Vec{-a[1] * thin, a[0] * thin}}};
  const double height = std::sqrt(size * a[1] * size * a[1] + thin * a[0] * thin * a[0]);
  made.query = {{random.between(-2, 2), within(random, source.precision, height, 1 - height)}, {1, 0}, {}};
}

void make_never(Source& source, Case& made) {
  static constexpr struct {
    const char* tag;
    void (*make)(Source&, Case&);
  } kKinds[] = {{"corridor", corridor},           {"plane", plane},
                {"cylinder", cylinder},           {"motif", motif},
                {"superposition", superposition}, {"ellipse", ellipse}};
  const auto& [tag, make] = kKinds[source.scene.below(6)];
  made.tags.emplace_back(tag);
  make(source, made);
  Random& random = source.random;
  Vec& v = made.query.v;
  const int exponent = random.exponent(-6, 6);
  v = scaled(v, std::ldexp(random.sign(), exponent));
  if (tagged(made.tags, random.one_in(4), "neighbour")) {
    const int i = random.axis(made.scene.dimension);
    const std::int64_t ulps = random.integer(1, 3);
    v[i] = v[i] == 0 ? std::ldexp(length(v) * random.sign(),
                                  static_cast<int>(-50 + missing_bits(source.precision) - ulps))
                     : moved(v[i], ulps, source.precision);
  }
}

}  // namespace

Family never() {
  return {"never",
          "Flights that never hit: corridors, planes, holes; and ones an ulp beside them.",
          {{"corridor", "along a corridor, of the square and other lattices"},
           {"plane", "between lattice planes, in any direction along them"},
           {"cylinder", "through the hole between overlapping spheres; no planar channel is open"},
           {"motif", "between rows of different obstacles"},
           {"superposition", "along a corridor that two lattices have in common"},
           {"ellipse", "past tilted ellipses"},
           {"neighbour", "v a few ulps off: mostly a hit, after some 10^15 cells",
            "v a few ulps off: mostly a hit, after some 10^6 cells"}},
          make_never};
}

}  // namespace lorentz::cases
