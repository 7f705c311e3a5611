// What the families of campaigns only are out to reach, decided exactly.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <lorentz/geometry.hpp>
#include <lorentz/margin.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/reduction.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/drawn_flights.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using lorentz::oracle::Oracle;

namespace {

constexpr std::uint64_t kSeed = 5;

bool has(const cases::Case& one, const char* tag) {
  return std::find(one.tags.begin(), one.tags.end(), tag) != one.tags.end();
}

// Calls visit(case, exact answer, the scene's oracle) for the first cases of a family.
template <class Visit>
void visit_cases(std::string_view name, std::uint64_t count, Visit visit) {
  const cases::Target& family = *cases::target_named(name);
  for (std::uint64_t index = 0; index < count; ++index) {
    const cases::Case one = family.make(kSeed, index);
    INFO(family.name() << ' ' << index << ", seed " << kSeed);
    const Oracle& oracle = cases::oracle_of(one.scene);
    visit(one, oracle.first_hit(one.query), oracle);
  }
}

}  // namespace

TEST_CASE("Times of the family early lie beside midway, and are rounded to where they are",
          "[fuzz][campaign_families]") {
  int odd = 0;
  visit_cases("early", 600, [&](const cases::Case& one, const Answer& exact, const Oracle&) {
    REQUIRE(exact.outcome == Outcome::hit);
    const Vec &x = one.query.x, &v = one.query.v;
    const int k = v[0] != 0 ? 0 : v[1] != 0 ? 1 : 2;
    // 54 bits, which a long double holds: (|x_k| - 4 k) / |v_k|, the radius being 5 k.
    const long double r = one.scene.lattices[0].atoms[0].radius,
                      midway = (std::fabs(static_cast<long double>(x[k])) - r / 5 * 4) / std::fabs(v[k]);
    REQUIRE(static_cast<double>(midway) != midway);
    REQUIRE((*exact.time < midway) == has(one, "early"));
    odd += (static_cast<double>(midway) < midway) != has(one, "early");
  });
  CHECK(odd > 200);  // 291 seen; where ties to even would go the other way
}

TEST_CASE("Flights of the family nearly-parallel end, farther than double-double can tell",
          "[fuzz][campaign_families]") {
  int far = 0, not_known = 0;
  visit_cases("nearly-parallel", 400, [&](const cases::Case& one, const Answer& exact, const Oracle&) {
    if (has(one, "parallel")) {
      REQUIRE(exact.outcome == Outcome::never);
      return;
    }
    REQUIRE(exact.outcome == Outcome::hit);
    far += *exact.time * length(one.query.v) > 0x1p90;
    not_known += Reduction(one.scene).fly(one.query).outcome == Outcome::undecided;
  });
  CHECK(far > 200);        // 348 seen
  CHECK(not_known > 200);  // 348 seen
}

TEST_CASE("Cases of the family ellipsoid-edges are decided by some ulps", "[fuzz][campaign_families]") {
  int close = 0, inside = 0, surface = 0;
  visit_cases("ellipsoid-edges", 400, [&](const cases::Case& one, const Answer& exact, const Oracle&) {
    const auto hardest = oracle::Margins(one.scene).hardest_decision(one.query, exact, 0);
    close += hardest && hardest->margin < 64;
    surface += has(one, "surface");
    inside += exact.outcome == Outcome::inside;
  });
  CHECK(close > 260);  // 334 seen
  CHECK(inside > surface / 4);
  CHECK(inside < surface);
}

TEST_CASE("Flights of the family drift last long before they meet a plane", "[fuzz][campaign_families]") {
  int long_flights = 0, by_bits = 0;
  visit_cases("drift", 400, [&](const cases::Case& one, const Answer& exact, const Oracle&) {
    if (!has(one, "by-bits")) return;
    ++by_bits;
    REQUIRE(exact.outcome == Outcome::hit);
    long_flights += *exact.time > 0x1p36;
  });
  CHECK(by_bits > 60);  // 76 seen
  CHECK(long_flights > by_bits / 2);
}

TEST_CASE("Starts of the family vast-ellipsoids lie in many obstacles", "[fuzz][campaign_families]") {
  int inside = 0;
  visit_cases("vast-ellipsoids", 96, [&](const cases::Case& one, const Answer& exact, const Oracle& oracle) {
    inside += exact.outcome == Outcome::inside;
    if (exact.outcome != Outcome::inside) return;
    cases::Case next = one;
    next.query.from = exact.obstacle;
    const Answer second = oracle.first_hit(next.query);
    REQUIRE(second.outcome == Outcome::inside);
  });
  CHECK(inside > 90);  // 96 seen
}

TEST_CASE("Starts of the family nearby are nearer to the obstacle that they enter than its radius",
          "[fuzz][campaign_families]") {
  visit_cases("nearby", 400, [&](const cases::Case& one, const Answer& exact, const Oracle&) {
    REQUIRE(exact.outcome == Outcome::hit);
    REQUIRE(*exact.time * length(one.query.v) < one.scene.lattices[0].atoms[0].radius);
  });
}

TEST_CASE("In the family unequal-radii both obstacles are met, and reduction knows most of it",
          "[fuzz][campaign_families]") {
  int known = 0, first = 0;
  visit_cases("unequal-radii", 200, [&](const cases::Case& one, const Answer& exact, const Oracle&) {
    known += Reduction(one.scene).fly(one.query).outcome == exact.outcome;
    first += exact.obstacle.atom == 0;
  });
  CHECK(known > 180);  // 200 seen
  CHECK(first > 55);   // 73 seen
  CHECK(first < 180);  // 73 seen
}

TEST_CASE("In the family dense-rows one of the first rows of a layer is hit", "[fuzz][campaign_families]") {
  int few = 0;
  visit_cases("dense-rows", 200, [&](const cases::Case&, const Answer& exact, const Oracle&) {
    few += exact.outcome == Outcome::hit && *exact.time < 8;
  });
  CHECK(few > 150);  // 200 seen
}

TEST_CASE("Starts of the family skin are nearer to the surface than an ulp of its place",
          "[fuzz][campaign_families]") {
  int hits = 0, together = 0, twins = 0;
  visit_cases("skin", 1200, [&](const cases::Case& one, const Answer& exact, const Oracle& oracle) {
    if (has(one, "twin")) {  // whose obstacle may contain the start
      ++twins;
      Query leaving = one.query;
      leaving.from = exact.obstacle;
      const Answer next = oracle.first_hit(leaving);
      together += exact.outcome == Outcome::hit && next.outcome == Outcome::hit &&
                  *next.time - *exact.time < 1e-12 / length(one.query.v);
      return;
    }
    REQUIRE(exact.outcome == Outcome::hit);
    const Atom& atom = one.scene.lattices[0].atoms[0];
    const double place = length(atom.position);
    hits += *exact.time * length(one.query.v) < place * 0x1p-40;
  });
  CHECK(hits > 690);      // 856 seen
  CHECK(twins > 270);     // 336 seen
  CHECK(together > 250);  // 315 seen
}

// Which kind of scene it is, for those who ask whether all kinds are met.
namespace {

std::string kind_of(const Scene& scene) {
  bool ellipsoids = false;
  for_each_atom(scene, [&](const Atom& atom) { ellipsoids |= !atom.is_ball(); });
  return (scene.dimension == 2 ? "2D " : "3D ") + std::string(ellipsoids                  ? "ellipsoids"
                                                              : scene.lattices.size() > 1 ? "superposition"
                                                              : scene.lattices[0].atoms.size() > 1 ? "motif"
                                                              : is_unit_scene(scene)               ? "unit"
                                                                                                   : "cell");
}

// The smallest radius or semiaxis, in units of the shortest lattice vector.
double size_of(const Scene& scene) {
  double size = HUGE_VAL, shortest = HUGE_VAL;
  for (const Lattice& lattice : scene.lattices)
    for (int i = 0; i < scene.dimension; ++i) shortest = std::min(shortest, length(lattice.vectors[i]));
  for_each_atom(scene, [&](const Atom& atom) {
    if (atom.is_ball()) size = std::min(size, atom.radius);
    for (const Vec& axis : atom.semiaxes) size = std::min(size, length(axis));
  });
  return size / shortest;
}

}  // namespace

TEST_CASE("Campaigns draw each size of obstacle, half a decade wide, in each kind of scene",
          "[fuzz][campaign_families]") {
  std::map<std::string, std::map<int, int>> met;  // by kind, and by half decades
  std::map<std::string, int> leaving;
  for (const cases::Target& target : cases::targets())
    for (std::uint64_t row = 0; row < 1000; ++row) {
      // The target that is for this does it early; others have a few scenes.
      if (target.name() != "sizes" && row >= 40) break;
      const cases::Case one = target.make(kSeed, row * cases::kCasesPerScene);
      ++met[kind_of(one.scene)][static_cast<int>(std::floor(2 * std::log10(size_of(one.scene))))];
      for (std::uint64_t i = 0; i < 8; ++i)
        leaving[kind_of(one.scene)] +=
            target.make(kSeed, row * cases::kCasesPerScene + i).query.from.has_value();
    }
  CHECK(met.size() == 10);
  for (auto& [kind, sizes] : met) {
    for (int half = kind.starts_with("2D") ? -23 : -13; half < -1; ++half) {
      INFO(kind << ", from 10^" << half / 2.0);
      CHECK(sizes[half] > 0);
    }
    INFO(kind);
    CHECK(leaving[kind] > 40);
  }
}

TEST_CASE("The first scenes of the family sizes are as widely spread as all of them",
          "[fuzz][campaign_families]") {
  // What a campaign of a minute comes to: each fifth of the range of magnitudes, in each kind of scene.
  std::map<std::string, std::set<int>> met;
  for (std::uint64_t row = 0; row < 96; ++row) {
    const Scene scene = cases::target_named("sizes")->make(kSeed, row * cases::kCasesPerScene).scene;
    const double least = scene.dimension == 2 ? -12 : -7;
    met[kind_of(scene)].insert(static_cast<int>(5 * std::log10(size_of(scene)) / least));
  }
  for (const auto& [kind, fifths] : met) {
    INFO(kind);
    CHECK(fifths.size() == 5);
  }
}
