// Decisions on states that are known to some bits only, against the exact oracle on the same flights.
#include <catch2/catch.hpp>
#include <cmath>

#include <lorentz/oracle.hpp>
#include "fuzz/families/family.hpp"
#include "tests/support/journeys.hpp"

using namespace lorentz;
using namespace lorentz::oracle;
using namespace lorentz::testing;

namespace {

// The start of a query, sqrt(2) 10^-450 added to the components of its velocity: as good as exact, but the
// program can't know. What it decides, it decides on enclosures.
Start veiled(const Query& query, int dimension) {
  Start start;
  start.from = query.from;
  for (int i = 0; i < 3; ++i) {
    start.x[i] = query.x[i];
    start.v[i] = Surd(Rational(query.v[i]));
    if (i >= dimension) continue;
    start.v[i].scale = rational_from("1e-450").value();
    start.v[i].root = 2.0;
  }
  return start;
}

bool is_moderate(const cases::Case& one) {
  for (const double component : one.query.v)
    if (component != 0 && (std::fabs(component) < 0x1p-300 || std::fabs(component) > 0x1p300)) return false;
  return true;
}

}  // namespace

TEST_CASE("Itinerary: what is certain of an enclosure is what the oracle says") {
  // All families of hard cases: near-rational slopes, grazing lines, corridors, ties, slender ellipsoids .. A
  // line that touches, two obstacles at once, or a start on a surface is decided by no precision; the rest
  // must be.
  constexpr std::uint64_t kSeed = 1801, kEach = 60;
  std::size_t same = 0, undecided = 0, of_hits = 0;
  for (const cases::Family& family : cases::families())
    for (std::uint64_t i = 0; i < kEach; ++i) {
      const cases::Case one = family.make(kSeed, i);
      if (!is_moderate(one)) continue;
      const Answer truth = Oracle(one.scene).first_hit(one.query);
      Journey journey = collisions(1);
      journey.most_bits = 1200;
      const Told told = follow(rational(one.scene), veiled(one.query, one.scene.dimension), journey);
      INFO(family.name() << " " << i);
      of_hits += truth.outcome == Outcome::hit;
      if (told.collisions.empty()) {
        ++undecided;
        continue;
      }
      ++same;
      REQUIRE(truth.outcome == Outcome::hit);
      REQUIRE(told.collisions[0].obstacle == truth.obstacle);
      REQUIRE(told.collisions[0].nearest_time == Approx(*truth.time).epsilon(1e-14));
    }
  UNSCOPED_INFO(same << " " << undecided << " " << of_hits);
  CHECK(same > 0.7 * of_hits);
}

TEST_CASE("Itinerary: an exact state is decided exactly, whatever the family") {
  constexpr std::uint64_t kSeed = 1802, kEach = 40;
  for (const cases::Family& family : cases::families())
    for (std::uint64_t i = 0; i < kEach; ++i) {
      const cases::Case one = family.make(kSeed, i);
      const Answer truth = Oracle(one.scene).first_hit(one.query);
      Start start;
      for (int k = 0; k < 3; ++k) {
        start.x[k] = one.query.x[k];
        start.v[k] = Surd(Rational(one.query.v[k]));
      }
      start.from = one.query.from;
      Journey journey = collisions(1, 3);
      const Told told = follow(rational(one.scene), start, journey);
      INFO(family.name() << " " << i);
      switch (truth.outcome) {
        case Outcome::hit:
          REQUIRE(told.collisions.size() == 1);
          CHECK(told.collisions[0].obstacle == truth.obstacle);
          break;
        case Outcome::never:
          CHECK(told.end.end == JourneyEnd::never);
          break;
        default:
          CHECK(told.end.end == JourneyEnd::inside);
      }
    }
}

TEST_CASE("Itinerary: with the fewest bits that will do, and with many, the same") {
  // Dense scenes, in which other obstacles are near, and precisions at which the state is barely known: what
  // is said to be certain then is held against 600 bits.
  constexpr std::uint64_t kSeed = 1803;
  const auto both = [](const RationalScene& scene, const Start& start, long bits) {
    Journey barely = collisions(10, 1), amply = collisions(10, 1);
    barely.first_bits = bits;
    barely.most_bits = bits;
    amply.first_bits = 600;
    const Told few = follow(scene, start, barely), many = follow(scene, start, amply);
    REQUIRE(many.collisions.size() == 10);
    for (std::size_t k = 0; k < few.collisions.size(); ++k)
      REQUIRE(few.collisions[k].obstacle == many.collisions[k].obstacle);
    return few.collisions.size();
  };
  std::size_t certain = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    cases::Random random(kSeed, "itinerary", i);
    const bool in_space = random.one_in(3);
    RationalScene scene = in_space ? unit(3, "0.55") : unit(2, random.one_in(2) ? "0.499" : "0.35");
    Start start;
    const Vec v = random.direction(in_space ? 3 : 2);
    for (int k = 0; k < (in_space ? 3 : 2); ++k) {
      start.x[k] = 0.5 + random.between(-0.01, 0.01);
      start.v[k] = Surd(Rational(v[k]));
    }
    certain += both(scene, start, 32 + static_cast<long>(random.below(40)));
  }
  CHECK(certain > 750);  // of 3000, so that the test is about something
}
