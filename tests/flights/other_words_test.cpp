// The same gas told in other words - another unit of length, another basis, turned - has the same free paths:
// to the bit where binary64 is exact, within chance where it is not. Seeds are in the tests.
#include <catch2/catch.hpp>

#include <cmath>

#include <lorentz/geometry.hpp>
#include "src/problem/scene_geometry.hpp"
#include "statistics/flights/run.hpp"
#include "tests/support/scenes.hpp"

using namespace lorentz;
using namespace lorentz::flights;

namespace {

FlightTally flown(const Scene& scene, Ensemble from, std::uint64_t seed, std::uint64_t count,
                  const char* engine = "batch") {
  FlightsPlan plan{scene, engine, from, seed, count};
  Account account;
  account.tally = FlightTally(unit_exponent(scene));
  run(plan, {.jobs = 2}, account);
  return account.tally;
}

// Rows of a linear map.
using Map = std::array<Vec, 3>;

Vec mapped(const Map& map, const Vec& x) {
  return {dot(map[0], x), dot(map[1], x), dot(map[2], x)};
}

// All of the scene under a map that keeps shapes: `factor` times a rotation.
Scene mapped(Scene scene, const Map& map, double factor) {
  for (Lattice& lattice : scene.lattices) {
    for (Vec& u : lattice.vectors) u = mapped(map, u);
    for (Atom& atom : lattice.atoms) {
      atom.position = mapped(map, atom.position);
      atom.radius *= factor;
      for (Vec& axis : atom.semiaxes) axis = mapped(map, axis);
    }
  }
  return scene;
}

Scene scaled_by(const Scene& scene, double factor) {
  return mapped(scene, {{{factor, 0, 0}, {0, factor, 0}, {0, 0, factor}}}, factor);
}

// By 0.7 about the third axis; in space then by 1.1 about the first.
Scene turned(const Scene& scene) {
  const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(1.1), e = std::sin(1.1);
  if (scene.dimension == 2) return mapped(scene, {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}}, 1);
  return mapped(scene, {{{c, -s, 0}, {d * s, d * c, -e}, {e * s, e * c, d}}}, 1);
}

// The same lattices: each vector plus, or less, another one; and atoms moved by vectors.
Scene in_another_basis(Scene scene) {
  for (Lattice& lattice : scene.lattices) {
    auto& u = lattice.vectors;
    u[0] = sum(u[0], u[1]);
    u[1] = sum(u[1], scaled(u[0], -2));
    if (scene.dimension == 3) u[2] = sum(u[2], u[1]);
    for (Atom& atom : lattice.atoms) atom.position = sum(atom.position, u[0]);
  }
  return scene;
}

// No symmetry but that of every lattice.
Scene two_discs() {
  Scene scene = test::one_atom(2, {{{1, 0, 0}, {0.3, 1.2, 0}}}, 0.1);
  scene.lattices[0].atoms.push_back({{0.55, 0.4, 0}, 0.2, {}});
  return scene;
}

Scene two_balls() {
  Scene scene = test::one_atom(3, {Vec{1, 0, 0}, Vec{0.3, 1.2, 0}, Vec{-0.2, 0.25, 0.9}}, 0.2);
  scene.lattices[0].atoms.push_back({{0.5, 0.7, 0.4}, 0.3, {}});
  return scene;
}

Scene ellipse_and_disc() {
  Scene scene = test::one_atom(2, {{{1, 0, 0}, {0, 1, 0}}}, 0.1);
  scene.lattices[0].atoms[0] = {{}, 0, {{0.3, 0.1, 0}, {-0.05, 0.15, 0}}};
  Lattice other = scene.lattices[0];
  other.vectors = {{{0.8, 0.6, 0}, {-0.75, 1, 0}}};
  other.atoms[0] = {{0.5, 0.5, 0}, 0.05, {}};
  scene.lattices.push_back(other);
  return scene;
}

}  // namespace

TEST_CASE("In units of a power of two all counts are the same, and all times that power of it",
          "[flights][other_words]") {
  for (const Scene& scene : {two_discs(), two_balls(), ellipse_and_disc()})
    for (const Ensemble from : {Ensemble::uniform, Ensemble::surface})
      for (const char* engine : {"batch", "certified-batch", "reduction"})
        for (const int power : {1, -7, 40}) {
          const double unit = std::ldexp(1, power);
          const FlightTally one = flown(scene, from, 7601, 5000, engine),
                            other = flown(scaled_by(scene, unit), from, 7601, 5000, engine);
          INFO(engine << ", 2^" << power << ", dimension " << scene.dimension);
          CHECK(one.hits + one.undecided == 5000);
          CHECK(other.hits == one.hits);
          CHECK(other.undecided == one.undecided);
          CHECK(other.inside == one.inside);
          CHECK(other.bins.exponent() == one.bins.exponent() + power);
          CHECK(other.bins.logarithmic == one.bins.logarithmic);
          CHECK(other.bins.linear == one.bins.linear);
          CHECK(other.time.value() == one.time.value() * unit);
          CHECK(other.square.value() == one.square.value() * unit * unit);
          CHECK(other.shortest == one.shortest * unit);
          CHECK(other.longest == one.longest * unit);
        }
}

namespace {

constexpr std::uint64_t kFlights = 1 << 17;

// The shares that fly farther than t, once an octave, of independent flights: by how many standard errors
// they differ at worst. `unit` is what a length 1 of the first has become in the second: 1 or 3, so that 3 t
// is an edge of bins, too.
double worst_departure(const FlightTally& one, const FlightTally& other, double unit) {
  double worst = 0;
  for (double t = 0.25; t <= 16; t *= 2) {
    const auto farther = [](const FlightTally& tally, double t) {
      std::uint64_t count = 0;
      for (int i = 0; i <= Bins::kLogarithmic; ++i)
        if (tally.bins.log_edge(i) >= t) count += tally.bins.logarithmic[static_cast<std::size_t>(i) + 1];
      return static_cast<double>(count) / kFlights;
    };
    const double p = farther(one, t), q = farther(other, t * unit), both = (p + q) / 2;
    worst = std::max(worst, std::fabs(p - q) / std::sqrt(2 * both * (1 - both) / kFlights));
  }
  return worst;
}

}  // namespace

TEST_CASE("In other units, in another basis, turned: the same law within chance", "[flights][other_words]") {
  for (const Scene& scene : {two_discs(), two_balls()})
    for (const Ensemble from : {Ensemble::uniform, Ensemble::surface}) {
      const FlightTally as_it_is = flown(scene, from, 7602, kFlights);
      const auto departure = [&](const Scene& told, std::uint64_t seed, double unit = 1) {
        const FlightTally other = flown(told, from, seed, kFlights);
        REQUIRE(other.hits == kFlights);
        return worst_departure(as_it_is, other, unit);
      };
      INFO("dimension " << scene.dimension << (from == Ensemble::uniform ? ", uniform" : ", surface"));
      CHECK(departure(scaled_by(scene, 3), 7603, 3) < 4);
      CHECK(departure(in_another_basis(scene), 7604) < 4);
      CHECK(departure(turned(scene), 7605) < 4);
      CHECK(departure(turned(in_another_basis(scaled_by(scene, 3))), 7606, 3) < 4);
      // Radii 5 % larger are another gas.
      Scene larger = scene;
      for_each_atom(larger, [](Atom& atom) { atom.radius *= 1.05; });
      CHECK(departure(larger, 7607) > 4);
    }
}
