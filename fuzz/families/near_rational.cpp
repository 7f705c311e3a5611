// near-rational: directions ulps from a lattice vector g, or with g as a convergent before a huge partial
// quotient. In the plane the continued fraction of the slope in lattice coordinates determines the first hit.
// v = n g + g' with det(g, g') = 1 has the convergent g and the next quotient about n, and the flight follows
// a row along g for about n cells. A slope of the golden ratio's convergents is the opposite: it takes the
// most steps. In space v ~ a g_1 + b g_2 lies near a lattice plane, at distance 1 / |g_1 x g_2| from the
// next. Radii bring the corridors (channels) of g within 2^-10 to 2^-50 of closing, relatively, or close them
// by as much.
#include <utility>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/drawn_flights.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {
namespace {

// A radius near the half width at which the corridors close.
double drawn_radius(Random& random, NumberFormat precision, double closing, std::vector<std::string>& tags) {
  const int least = -51 + missing_bits(precision);
  const std::string_view size =
      drawn_tag(random, tags, {"corridor-open", "just-open", "just-closed", "small-radius"});
  if (size == "corridor-open") return closing * random.between(0.05, 0.9);
  if (size == "just-open") return closing * (1 - random.octave(least, -10));
  if (size == "just-closed") return closing * (1 + random.octave(least, -10));
  return closing * random.octave(-18, -4);
}

// F_(n+1) u_1 + F_n u_2
IntVec golden(Random& random, NumberFormat precision) {
  const std::int64_t most = precision == NumberFormat::binary64 ? 70 : 30;
  std::int64_t a = 1, b = 1;
  for (std::int64_t steps = random.integer(5, most); steps > 0; --steps) b = std::exchange(a, a + b);
  return {a, b, 0};
}

Vec flat_direction(Random& random, NumberFormat precision, const Lattice& lattice, const IntVec& g,
                   const IntVec& next, std::vector<std::string>& tags) {
  const int missing = missing_bits(precision);
  const std::string_view kind =
      drawn_tag(random, tags, {"ulps-off-rational", "neighbours", "huge-quotient", "golden"});
  if (kind == "neighbours") {
    const std::int64_t n = random.integer(1, std::int64_t{1} << random.integer(2, 44 - missing));
    return cartesian(lattice, {n * g[0] + next[0], n * g[1] + next[1], 0});
  }
  if (kind == "huge-quotient") {
    const double drift = random.octave(-52 + missing, -8) * random.sign();
    return plus(cartesian(lattice, g), drift, cartesian(lattice, next));
  }
  if (kind == "golden") {
    Vec v = cartesian(lattice, golden(random, precision));
    jitter(random, v, 2, 2, precision);
    return v;
  }
  Vec v = scaled(cartesian(lattice, g), random.whole(1, 99));
  jitter(random, v, 2, 3, precision);
  return v;
}

void make_flat(Source& source, Case& made) {
  made.scene = source.scene.one_in(2) ? unit_scene(2, 1) : drawn_crystal(source.scene, 2).scene;
  const Lattice& lattice = made.scene.lattices[0];
  const IntVec g = drawn_primitive(source.scene, 2, source.scene.one_in(4) ? 200 : 9), u = bezout(g);
  const IntVec next{-u[1], u[0], 0};  // det(g, next) = 1
  set_radius(made.scene, drawn_radius(source.scene, source.precision, half_width(lattice, 2, g), made.tags));
  Random& random = source.random;
  made.query.v = flat_direction(random, source.precision, lattice, g, next, made.tags);
  if (random.one_in(2)) {  // in the middle of a corridor
    const double off =
        random.one_in(2) ? 0 : random.octave(-50 + missing_bits(source.precision), -10) * random.sign();
    made.query.x = sum(scaled(cartesian(lattice, g), random.between(-1, 1)),
                       scaled(cartesian(lattice, next), 0.5 + off));
  } else {
    made.query.x = free_point(random, made.scene);
  }
}

Vec solid_direction(Random& random, NumberFormat precision, const Lattice& lattice, const IntVec& g1,
                    const IntVec& g2, const IntVec& next, std::vector<std::string>& tags) {
  if (tagged(tags, random.one_in(2), "ulps-off-rational", "near-plane")) {
    IntVec g{};
    const std::int64_t a = random.integer(-9, 9), b = random.integer(1, 9);
    for (int i = 0; i < 3; ++i) g[i] = a * g1[i] + b * g2[i];
    Vec v = scaled(cartesian(lattice, g), random.whole(1, 99));
    jitter(random, v, 3, 3, precision);
    return v;
  }
  const double along_2 = random.between(0.1, 1), along_1 = random.between(-1, 1);
  const Vec in_plane = sum(scaled(cartesian(lattice, g1), along_1), scaled(cartesian(lattice, g2), along_2));
  const double slope = random.octave(-52 + missing_bits(precision), -8) * random.sign();
  return sum(in_plane, scaled(cartesian(lattice, next), slope));
}

// Planes with the indices n: g_1, g_2 span a sublattice of each, and next . n = 1.
void make_solid(Source& source, Case& made) {
  made.scene = source.scene.one_in(2) ? unit_scene(3, 1) : drawn_crystal(source.scene, 3).scene;
  const Lattice& lattice = made.scene.lattices[0];
  const IntVec n = drawn_primitive(source.scene, 3, source.scene.one_in(4) ? 12 : 2), next = bezout(n);
  const auto [g1, g2] = across_of(n);
  set_radius(made.scene, drawn_radius(source.scene, source.precision, half_width(lattice, 3, n), made.tags));
  Random& random = source.random;
  made.query.v = solid_direction(random, source.precision, lattice, g1, g2, next, made.tags);
  if (random.one_in(2)) {  // in the middle of a channel
    const double off =
        random.one_in(2) ? 0 : random.octave(-50 + missing_bits(source.precision), -10) * random.sign();
    const double along_2 = random.uniform(), along_1 = random.uniform();
    made.query.x = sum(sum(scaled(cartesian(lattice, g1), along_1), scaled(cartesian(lattice, g2), along_2)),
                       scaled(cartesian(lattice, next), 0.5 + off));
  } else {
    made.query.x = free_point(random, made.scene);
  }
}

}  // namespace

Family near_rational() {
  return {
      "near-rational",
      "Directions ulps from lattice vectors, or with huge partial quotients.",
      {{"ulps-off-rational", "an ulp decides whether the flight ends here or in 10^15 cells",
        "an ulp decides whether the flight ends here or in 10^6 cells"},
       {"neighbours",
        "n times a lattice vector plus its neighbour in the Stern-Brocot tree: rows of n "
        "obstacles, and 2^44 fold steps for who walks them",
        "n times a lattice vector plus its neighbour in the Stern-Brocot tree: rows of n "
        "obstacles, and 2^15 fold steps for who walks them"},
       {"huge-quotient", "a small slope against a lattice vector: one partial quotient of up to 2^52",
        "a small slope against a lattice vector: one partial quotient of up to 2^23"},
       {"golden", "all partial quotients 1: the longest continued fraction"},
       {"near-plane", "a small slope against a lattice plane: thousands of rows in one plane"},
       {"corridor-open", "the corridors along the lattice vector are open"},
       {"just-open", "they are open by a relative 2^-10 to 2^-51",
        "they are open by a relative 2^-10 to 2^-22, before rounding"},
       {"just-closed", "they are closed by as little"},
       {"small-radius", "obstacles small against the corridors"}},
      [](Source& source, Case& made) { (source.scene.one_in(3) ? make_solid : make_flat)(source, made); }};
}

}  // namespace lorentz::cases
