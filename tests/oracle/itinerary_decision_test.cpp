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

TEST_CASE("Itinerary: what is left is near while two obstacles are entered at nearly the same time") {
  // In the corner of three overlapping discs: the particle leaves the first, and all that it meets is as near
  // as discs are grown by for a first decision (2^-32 of a radius). Grown discs are entered in another order
  // than the discs, because one is met at a small angle.
  const auto told_among = [](const std::vector<int>& discs, int nearness) {
    RationalScene scene = unit(2, "1/4");
    scene.lattices[0].vectors = {};
    scene.lattices[0].rank = 0;
    const RationalAtom left{{exact("-10/41"), exact("9/164")}, exact("1/4"), {}};
    const auto radius = [](int below) {  // in tenths of 2^-34 below 1/4
      return exact(std::to_string((10L << 32) - below) + "/" + std::to_string(10L << 34));
    };
    const std::array<RationalAtom, 2> ahead{
        RationalAtom{{exact("3/13"), exact("-5/52")}, radius(nearness), {}},
        RationalAtom{{Rational(0.0), exact("1/4")}, radius(40), {}}};
    scene.lattices[0].atoms = {left};
    for (const int disc : discs) scene.lattices[0].atoms.push_back(ahead[disc]);
    Start start = start_at({"0", "0"}, {"1", "sqrt(2)"});
    start.from = ObstacleId{0, 0, {}};
    return follow(scene, start, collisions(1)).collisions.at(0);
  };
  std::array<int, 2> first{};
  for (int nearness = 5; nearness < 20; ++nearness) {
    INFO(nearness);
    const std::array<CertifiedCollision, 2> alone{told_among({0}, nearness), told_among({1}, nearness)};
    const int earlier = alone[0].nearest_time < alone[1].nearest_time ? 0 : 1;
    const CertifiedCollision told = told_among({0, 1}, nearness);
    CHECK(told.obstacle.atom == 1 + earlier);
    CHECK(told.time == alone[earlier].time);
    ++first[earlier];
  }
  CHECK(first == std::array{6, 9});
}

TEST_CASE("Itinerary: a time is as uncertain as all flights before it") {
  // The direction is such that the length of the seventh flight does not depend on it, to first order: the
  // error of its time is that of the flights before. At these bits 30 digits are nearly certain.
  const Start start = start_at({"1/2", "446/997"}, {"1", "sqrt(6719267626/29376002769)"});
  const auto told_with = [&](long bits) {
    Journey journey = collisions(7, 30);
    journey.first_bits = bits;
    const Told told = follow(unit(2, "1/5"), start, journey);
    std::vector<std::string> times;
    for (const CertifiedCollision& collision : told.collisions) times.push_back(collision.time);
    return times;
  };
  const std::vector<std::string> truth = told_with(600);
  CHECK(truth.size() == 7);
  for (long bits = 100; bits < 140; ++bits) {
    INFO(bits);
    CHECK(told_with(bits) == truth);
  }
}
