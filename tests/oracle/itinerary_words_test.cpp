// One journey told in other words: another precision, time reversed, another basis, place, frame, unit.
#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <functional>

#include "tests/support/journeys.hpp"

using namespace lorentz;
using namespace lorentz::oracle;
using namespace lorentz::testing;

namespace {

constexpr std::uint64_t kCollisions = 60;

using Number = boost::multiprecision::cpp_rational;
using Pair = std::array<Number, 2>;
using Map = std::function<Pair(const Pair&)>;

RationalVec told_as(const Pair& a) {
  return {exact(a[0].str()), exact(a[1].str()), 0.0};
}

Pair same(const Pair& a) {
  return a;
}

// A motif of a disc and an ellipse in an oblique lattice, as a map leaves it that is a similarity of this
// ratio.
RationalScene oblique(const Map& map = same, const Number& ratio = 1) {
  RationalScene scene{2, {RationalLattice{}}};
  scene.lattices[0].vectors[0] = told_as(map({1, 0}));
  scene.lattices[0].vectors[1] = told_as(map({Number(1, 3), Number(9, 10)}));
  RationalAtom disc, ellipse;
  disc.radius = exact((ratio * Number(1, 7)).str());
  ellipse.position = told_as(map({Number(1, 2), Number(2, 5)}));
  ellipse.semiaxes = {told_as(map({Number(1, 5), Number(1, 10)})),
                      told_as(map({Number(-1, 20), Number(1, 10)}))};
  scene.lattices[0].atoms = {disc, ellipse};
  return scene;
}

Start start(const Map& map = same) {
  Start start;
  start.x = told_as(map({Number(1, 4), Number(2, 7)}));
  const RationalVec v = told_as(map({1, Number(3, 11)}));
  for (int i : {0, 1}) start.v[i] = Surd(v[i]);
  return start;
}

// The middle of the last flight, in time, as a text.
std::string before_the_last(const Told& told) {
  const std::size_t n = told.collisions.size();
  return std::to_string((told.collisions[n - 2].nearest_time + told.collisions[n - 1].nearest_time) / 2);
}

Start reversed(const Arrival& end) {
  Start back;
  for (std::size_t i = 0; i < end.x.size(); ++i) {
    back.x[i] = exact(end.x[i]);
    back.v[i] = Surd(exact(end.v[i].front() == '-' ? end.v[i].substr(1) : "-" + end.v[i]));
  }
  return back;
}

}  // namespace

TEST_CASE("Itinerary: more bits than needed change nothing") {
  const Told told = follow(oblique(), start(), collisions(kCollisions));
  REQUIRE(told.collisions.size() == kCollisions);
  oracle::Journey journey = collisions(kCollisions);
  journey.first_bits = 2 * told.end.bits;
  const Told again = follow(oblique(), start(), journey);
  CHECK(again.word() == told.word());
  for (std::size_t k = 0; k < kCollisions; ++k) CHECK(again.collisions[k].time == told.collisions[k].time);
  CHECK(again.end.x == told.end.x);
  CHECK(again.end.v == told.end.v);
}

TEST_CASE("Itinerary: reversed, a particle comes back to its start") {
  for (const bool in_space : {false, true}) {
    const RationalScene scene = in_space ? unit(3, "2/5") : oblique();
    const Start there = in_space ? start_at({"1/2", "1/2", "3/7"}, {"1", "3/11", "5/7"}) : start();
    const Told whole = follow(scene, there, collisions(kCollisions));
    REQUIRE(whole.collisions.size() == kCollisions);
    // From a free place, as far as 120 decimals tell it, with the velocity turned round.
    const std::string time = before_the_last(whole);
    const Told forth = follow(scene, there, until(time, 120));
    const Told back = follow(scene, reversed(forth.end), until(time, 20));
    std::vector<ObstacleId> word = back.word();
    std::reverse(word.begin(), word.end());
    CHECK(word == forth.word());
    CHECK(word.size() == kCollisions - 1);
    for (std::size_t i = 0; i < back.end.x.size(); ++i) {
      CHECK(std::stod(back.end.x[i]) == Approx(nearest(there.x[i])).epsilon(1e-15));
      CHECK(std::stod(back.end.v[i]) == Approx(-nearest(there.v[i].shift)).epsilon(1e-15));
    }
  }
}

TEST_CASE("Itinerary: in another basis, elsewhere, turned, and in another unit") {
  const Told told = follow(oblique(), start(), collisions(kCollisions));
  REQUIRE(told.collisions.size() == kCollisions);

  SECTION("another basis: u' = u + 2 w, w' = u + 3 w") {
    RationalScene scene = oblique();
    scene.lattices[0].vectors = {RationalVec{exact("5/3"), exact("9/5"), 0.0},
                                 RationalVec{exact("2"), exact("27/10"), 0.0}, RationalVec{}};
    const Told other = follow(scene, start(), collisions(kCollisions));
    REQUIRE(other.collisions.size() == kCollisions);
    for (std::size_t k = 0; k < kCollisions; ++k) {
      const ObstacleId &a = told.collisions[k].obstacle, &b = other.collisions[k].obstacle;
      CHECK(a.atom == b.atom);
      CHECK(a.cell[0].int64() == b.cell[0].int64() + b.cell[1].int64());
      CHECK(a.cell[1].int64() == 2 * b.cell[0].int64() + 3 * b.cell[1].int64());
      CHECK(told.collisions[k].time == other.collisions[k].time);
    }
    CHECK(told.end.x == other.end.x);
    CHECK(told.end.v == other.end.v);
  }
  SECTION("a billion cells away") {
    Start far = start();
    far.x = {exact("1000000000.25"), exact("2/7"), 0.0};
    const Told other = follow(oblique(), far, collisions(kCollisions));
    REQUIRE(other.collisions.size() == kCollisions);
    for (std::size_t k = 0; k < kCollisions; ++k) {
      ObstacleId moved = told.collisions[k].obstacle;
      moved.cell[0] = Integer(moved.cell[0].int64() + 1'000'000'000);
      CHECK(other.collisions[k].obstacle == moved);
      CHECK(told.collisions[k].time == other.collisions[k].time);
    }
    CHECK(told.end.v == other.end.v);
  }
  SECTION("turned, by cos = 3/5") {
    const Map turn = [](const Pair& a) -> Pair {
      return {(3 * a[0] - 4 * a[1]) / 5, (4 * a[0] + 3 * a[1]) / 5};
    };
    const Told other = follow(oblique(turn), start(turn), collisions(kCollisions));
    CHECK(told.word() == other.word());
    for (std::size_t k = 0; k < kCollisions; ++k) CHECK(told.collisions[k].time == other.collisions[k].time);
  }
  SECTION("in a unit a third as long") {
    const Map map = [](const Pair& a) -> Pair { return {3 * a[0], 3 * a[1]}; };
    const Told other = follow(oblique(map, 3), start(map), collisions(kCollisions));
    CHECK(told.word() == other.word());
    for (std::size_t k = 0; k < kCollisions; ++k) CHECK(told.collisions[k].time == other.collisions[k].time);
  }
  SECTION("at another speed") {
    Start fast = start();
    fast.v[0] = *surd_from("7e300");
    fast.v[1] = Surd(exact("21" + std::string(300, '0') + "/11"));
    const Told other = follow(oblique(), fast, collisions(kCollisions));
    CHECK(told.word() == other.word());
    for (std::size_t k = 0; k < kCollisions; ++k)
      CHECK(told.collisions[k].nearest_time ==
            Approx(7e300 * other.collisions[k].nearest_time).epsilon(1e-14));
  }
}

TEST_CASE("Itinerary: every place and velocity told lies on a disc, and has the speed of the start") {
  oracle::Journey journey = collisions(100, 40);
  journey.states = true;
  const Told told = follow(unit(3, "2/5"), start_at({"1/2", "1/2", "3/7"}, {"2/7", "3/7", "6/7"}), journey);
  REQUIRE(told.collisions.size() == 100);
  for (const auto& c : told.collisions) {
    double square = 0, speed = 0;
    for (int i = 0; i < 3; ++i) {
      square += c.offset[i] * c.offset[i];
      speed += std::stod(c.v[i]) * std::stod(c.v[i]);
      CHECK(std::stod(c.x[i]) - static_cast<double>(c.obstacle.cell[i].int64()) ==
            Approx(c.offset[i]).margin(1e-12));
    }
    CHECK(square == Approx(0.16).epsilon(1e-14));
    CHECK(speed == Approx(1).epsilon(1e-14));
  }
}
