// Certified itineraries against published digits and closed forms, and how they end.
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <catch2/catch.hpp>

#include <lorentz/errors.hpp>
#include "tests/support/journeys.hpp"

using namespace lorentz;
using namespace lorentz::oracle;
using namespace lorentz::testing;
using Decimal = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<200>>;

namespace {

ObstacleId disc(std::int64_t a, std::int64_t b) {
  return {0, 0, {a, b, 0}};
}

bool begins(const std::string& text, const std::string& beginning) {
  return text.substr(0, beginning.size()) == beginning;
}

Arrival challenge(const std::string& time, int digits) {
  return follow(unit(2, "1/3"), start_at({"1/2", "1/10"}, {"1", "0"}), until(time, digits)).end;
}

}  // namespace

TEST_CASE("Itinerary: problem 2 of the 100-digit challenge, to the published digits") {
  const Told told = follow(unit(2, "1/3"), start_at({"1/2", "1/10"}, {"1", "0"}), until("10", 79));
  CHECK(told.end.end == JourneyEnd::time);
  CHECK(told.end.distance ==
        "0.9952629194433541608903118094267216210294669227341543498032088580729861796228306");
  const std::vector<ObstacleId> discs{disc(1, 0),  disc(-1, 1),  disc(0, 2),  disc(0, 1),  disc(-1, 2),
                                      disc(0, 0),  disc(-1, 0),  disc(0, 1),  disc(0, 0),  disc(-1, 0),
                                      disc(0, -1), disc(-1, -1), disc(-1, 0), disc(-1, -1)};
  CHECK(told.word() == discs);
  // It has lost what an error of the start grows: a stretching of exp(25.85), that is 37 bits, and some for
  // the radius and the angle of the last collision.
  CHECK(told.collisions.back().bits >= 37);
  CHECK(told.collisions.back().bits <= 44);
}

// Computed in Python with decimals of 400 digits, disc by disc.
TEST_CASE("Itinerary: the challenge's particle at later times") {
  CHECK(begins(challenge("20", 30).distance, "1.704302344995256755551595314"));
  CHECK(begins(challenge("50", 30).distance, "7.714706455990873366619754440"));
  CHECK(begins(challenge("100", 30).distance, "9.166851661380233731871600625"));
  CHECK(begins(challenge("200", 30).distance, "11.203273788764400671551256471"));
  CHECK(challenge("20", 17).collisions == 21);
  CHECK(challenge("50", 17).collisions == 52);
  CHECK(challenge("100", 17).collisions == 96);
  CHECK(challenge("200", 17).collisions == 195);
}

TEST_CASE("Itinerary: a second public problem, x = (0.5, 0.26)") {
  const Arrival end = follow(unit(2, "1/3"), start_at({"0.5", "0.26"}, {"1", "0"}), until("20", 31)).end;
  CHECK(end.collisions == 16);
  CHECK(end.distance == "4.110380647685314510291949635114");
  CHECK(begins(end.x[0], "4.0945566"));
  CHECK(begins(end.x[1], "-0.3603266"));
}

TEST_CASE("Itinerary: with the binary64 numbers next to these it is another problem") {
  const Told told = follow(rational(unit_scene(2, 1.0 / 3)),
                           start_at({"0.5", "0x1.999999999999ap-4"}, {"1", "0"}), until("10", 32));
  CHECK(told.end.distance == "0.99526213359997041031848922807518");
}

TEST_CASE("Itinerary: not more bits than the flow itself loses") {
  // Boxes along the axes need 96 bits to decide it, and a true loss of 37 sets the other bound.
  oracle::Journey journey = until("10", 1);
  journey.first_bits = 50;
  CHECK(follow(unit(2, "1/3"), start_at({"1/2", "1/10"}, {"1", "0"}), journey).end.bits == 50);
}

TEST_CASE("Itinerary: head-on between two discs small distances grow by the closed form") {
  // Off the axis by 10^-60: each bounce multiplies that by L/r - 1 + (L/r) sqrt(1 - 2 r / L), after the first
  // few.
  oracle::Journey journey = collisions(30, 80);
  journey.states = true;
  const Told told = follow(unit(2, "1/4"), start_at({"1/2", "1e-60"}, {"1", "0"}), journey);
  const Decimal multiplier = 3 + 4 * sqrt(Decimal(1) / 2);
  for (std::size_t k = 22; k < 30; ++k) {
    const Decimal ratio = Decimal(told.collisions[k].x[1]) / Decimal(told.collisions[k - 1].x[1]);
    CHECK(abs(ratio / multiplier - 1) < Decimal("1e-30"));
  }
}

TEST_CASE("Itinerary: lines before and after an ellipse touch the same confocal conic") {
  // The tangent of a line with unit velocity v at the place x from the centre: a^2 v2^2 + b^2 v1^2 - (x x
  // v)^2.
  RationalScene scene = unit(2, "1");
  scene.lattices[0].atoms[0].semiaxes = {{exact("2/5"), 0.0, 0.0}, {0.0, exact("1/5"), 0.0}};
  oracle::Journey journey = collisions(60, 60);
  journey.states = true;
  const Told told = follow(scene, start_at({"1/2", "1/2"}, {"3/5", "4/5"}), journey);
  REQUIRE(told.collisions.size() == 60);
  std::array<Decimal, 2> before{Decimal(3) / 5, Decimal(4) / 5};
  for (const CertifiedCollision& c : told.collisions) {
    const std::array<Decimal, 2> after{Decimal(c.v[0]), Decimal(c.v[1])};
    const Decimal x = Decimal(c.x[0]) - Decimal(c.obstacle.cell[0].decimal()),
                  y = Decimal(c.x[1]) - Decimal(c.obstacle.cell[1].decimal());
    const auto conic = [&](const std::array<Decimal, 2>& v) {
      const Decimal across = x * v[1] - y * v[0];
      return Decimal(4) / 25 * v[1] * v[1] + Decimal(1) / 25 * v[0] * v[0] - across * across;
    };
    CHECK(abs(conic(before) - conic(after)) < Decimal("1e-58"));
    CHECK(abs(25 * x * x / 4 + 25 * y * y - 1) < Decimal("1e-56"));
    CHECK(abs(after[0] * after[0] + after[1] * after[1] - 1) < Decimal("1e-58"));
    before = after;
  }
}

TEST_CASE("Itinerary: an orbit of rational points is exact at every precision") {
  const Told told = follow(unit(2, "1/4"), start_at({"1/2", "0"}, {"1", "0"}), collisions(1000));
  REQUIRE(told.collisions.size() == 1000);
  CHECK(told.collisions[999].time == "499.75000000000000");
  CHECK(told.collisions[999].bits == 0);
  // The time of the last collision counts.
  CHECK(follow(unit(2, "1/4"), start_at({"1/2", "0"}, {"1", "0"}), until("0.75")).end.collisions == 2);
}

TEST_CASE("Itinerary: how journeys end") {
  const auto end_of = [](const Start& start, const oracle::Journey& journey) {
    return follow(unit(2, "1/4"), start, journey).end;
  };
  SECTION("never: along a corridor") {
    const Arrival end = end_of(start_at({"0", "1/2"}, {"1", "0"}), collisions(5));
    CHECK(end.end == JourneyEnd::never);
    CHECK(end.collisions == 0);
  }
  SECTION("the same, to a time") {
    const Arrival end = end_of(start_at({"0", "1/2"}, {"1", "0"}), until("1/3"));
    CHECK(end.end == JourneyEnd::time);
    CHECK(end.x == std::vector<std::string>{"0.33333333333333333", "0.50000000000000000"});
  }
  SECTION("inside") {
    const Arrival end = end_of(start_at({"1/8", "0"}, {"1", "0"}), collisions(5));
    CHECK(end.end == JourneyEnd::inside);
    // Whichever way it would fly.
    CHECK(end_of(start_at({"1/8", "0"}, {"1", "golden"}), collisions(5)).end == JourneyEnd::inside);
    // Out of a disc that it leaves, by mistake, into one that overlaps it: after the collision it is inside.
    RationalScene scene = unit(2, "2/5");
    scene.lattices[0].atoms.push_back(scene.lattices[0].atoms[0]);
    scene.lattices[0].atoms[1].position[0] = exact("1/5");
    scene.lattices[0].atoms[1].radius = exact("1/10");
    Start wrong = start_at({"-1/10", "1/50"}, {"1", "0"});
    wrong.from = ObstacleId{0, 0, {0, 0, 0}};
    const Told told = follow(scene, wrong, collisions(4));
    CHECK(told.end.end == JourneyEnd::inside);
    CHECK(told.end.collisions == 1);
  }
  SECTION("a line that touches is no hit") {
    const Told told = follow(unit(2, "1/4"), start_at({"0", "1/4"}, {"1", "0"}), collisions(1));
    CHECK(told.end.end == JourneyEnd::never);
  }
  SECTION("an irrational line that touches is decided by no precision") {
    // From (1/2, 0) at 150 degrees: the distance from the origin is 1/4.
    Start start = start_at({"1/2", "0"}, {});
    start.degrees = exact("150");
    oracle::Journey journey = collisions(5);
    journey.most_bits = 1000;
    const Arrival end = end_of(start, journey);
    CHECK(end.end == JourneyEnd::undecided);
    CHECK(end.collisions == 0);
    CHECK(end.bits == 1000);
  }
  SECTION("at once") {
    CHECK(end_of(start_at({"1/2", "1/2"}, {"1", "0"}), collisions(0)).collisions == 0);
  }
  SECTION("as the listener wishes") {
    const Arrival end = Itinerary(unit(2, "1/4"))
                            .follow(start_at({"1/2", "1/3"}, {"1", "golden"}), collisions(50),
                                    [](const CertifiedCollision& c) { return c.nearest_time < 3; });
    CHECK(end.end == JourneyEnd::collisions);
    CHECK(end.collisions < 20);
  }
}

TEST_CASE("Itinerary: a journey that is stopped ends there, told or silent") {
  std::atomic<bool> stop = false;
  oracle::Journey journey = collisions(100'000);
  journey.stop = &stop;
  const Itinerary itinerary(unit(2, "1/3"));
  const Start start = start_at({"1/2", "1/10"}, {"1", "0"});
  std::uint64_t told = 0;
  const auto count = [&](const CertifiedCollision&) {
    stop = ++told == 300;
    return true;
  };
  const Arrival arrival = itinerary.follow(start, journey, count);
  CHECK(told == 300);
  CHECK(arrival.end == JourneyEnd::undecided);
  CHECK(arrival.collisions == 300);
  stop = true;
  CHECK(itinerary.follow(start, journey, count).collisions == 0);
  CHECK(told == 300);
}

TEST_CASE("Itinerary: a corner between overlapping discs, and a particle in a pocket") {
  // Radius 3/5: the plane falls into pockets around (1/2, 1/2).
  const Told told = follow(unit(2, "3/5"), start_at({"1/2", "1/2"}, {"1", "golden"}), collisions(200));
  REQUIRE(told.collisions.size() == 200);
  for (const ObstacleId& obstacle : told.word())
    for (int i : {0, 1}) CHECK((obstacle.cell[i] == Integer(0) || obstacle.cell[i] == Integer(1)));
  // Straight into a corner: two discs at once, the smaller one counts (exactly decided), and from there it
  // flies into the other at once.
  const Told corner = follow(unit(2, "3/5"), start_at({"1/2", "1/2"}, {"1", "0"}), collisions(2));
  REQUIRE(!corner.collisions.empty());
  CHECK(corner.collisions[0].obstacle == disc(1, 0));
}

TEST_CASE("Itinerary: directions beyond rational numbers") {
  const auto first_time = [](const Start& start) {
    return follow(unit(2, "1/4"), start, collisions(1, 30)).collisions.at(0).time;
  };
  Start turned = start_at({"1/2", "1/2"}, {});
  turned.degrees = exact("36");
  Start golden = start_at({"1/2", "1/2"}, {"1", "golden"});
  Start root = start_at({"1/2", "1/2"}, {"1", "sqrt(2)"});
  // By hand: the first disc that each meets, and t = (s - sqrt(r^2 v^2 - h^2)) / v^2 in 50 digits.
  const auto time = [](const Decimal& vx, const Decimal& vy, int cx, int cy) {
    const Decimal x = cx - Decimal(1) / 2, y = cy - Decimal(1) / 2, v2 = vx * vx + vy * vy;
    const Decimal s = vx * x + vy * y, h = vx * y - vy * x;
    return Decimal((s - sqrt(v2 / 16 - h * h)) / v2).str(30);
  };
  const Decimal pi = boost::math::constants::pi<Decimal>();
  CHECK(first_time(turned) == time(cos(pi / 5), sin(pi / 5), 1, 1));
  CHECK(first_time(golden) == time(1, (1 + sqrt(Decimal(5))) / 2, 1, 1));
  CHECK(first_time(root) == time(1, sqrt(Decimal(2)), 1, 1));
}

TEST_CASE("Itinerary: among obstacles far smaller than the bits to begin with") {
  // To and fro between two discs of radius r, head-on; an error of the start grows by 2 / r each time.
  for (const char* radius : {"1e-30", "1e-100", "1e-300", "1e-400", "1e-1000"}) {
    INFO(radius);
    // To the first alone it arrives with an error that is many times r, which is where precision went below
    // 0.
    const Told first = follow(unit(2, radius), start_at({"1/2", "0"}, {"1", "0"}), collisions(1));
    CHECK(first.word() == std::vector<ObstacleId>{disc(1, 0)});
    const Told told = follow(unit(2, radius), start_at({"1/2", "0"}, {"1", "0"}), collisions(3));
    CHECK(told.word() == std::vector<ObstacleId>{disc(1, 0), disc(0, 0), disc(1, 0)});
    CHECK(told.collisions.back().time == "2.5000000000000000");
  }
}

TEST_CASE("Itinerary: scenes and starts with a flaw are errors with a place") {
  RationalScene dependent = unit(2, "1/4");
  dependent.lattices[0].vectors[1] = {exact("1/3"), 0.0, 0.0};
  CHECK_THROWS_WITH(Itinerary(dependent), Catch::Contains("lattice 0: the primitive vectors"));
  CHECK_THROWS_WITH(Itinerary(unit(2, "-1/4")), Catch::Contains("lattice 0, atom 0: radius"));
  Journey no_digits = collisions(1);
  no_digits.digits = 0;
  CHECK_THROWS_AS(Itinerary(unit(2, "1/4")).follow(start_at({"1/2", "1/2"}, {"1", "0"}), no_digits),
                  InputError);
  for (const char* time : {"-1/3", "0", "-0"})
    CHECK_THROWS_WITH(Itinerary(unit(2, "1/4")).follow(start_at({"1/2", "1/2"}, {"1", "0"}), until(time, 17)),
                      Catch::Contains("time"));
  CHECK_THROWS_AS(Itinerary(unit(2, "1/4")).follow(start_at({"1/2", "1/2"}, {"0", "sqrt(0)"}), collisions(1)),
                  InputError);
}

TEST_CASE("Itinerary: numbers far below the unit have digits, too") {
  // From 10^-20 off the line between two discs that touch: the first time is 3e-40.
  const Told told = follow(unit(2, "1/2"), start_at({"1/2", "1e-20"}, {"1/3", "1/7"}), collisions(3));
  REQUIRE(told.collisions.size() == 3);
  CHECK(told.collisions[0].time == "3.0000000000000000e-40");
  CHECK(told.collisions[1].time == "9.0000000000000000e-40");
  // In a unit of 10^-20.
  RationalScene scene = unit(2, "5e-21");
  for (int i : {0, 1}) scene.lattices[0].vectors[i][i] = exact("1e-20");
  oracle::Journey journey = collisions(2, 1);
  journey.states = true;
  const Told small = follow(scene, start_at({"4e-21", "5e-21"}, {"1e-20", "3e-21"}), journey);
  REQUIRE(small.collisions.size() == 2);
  for (const auto& c : small.collisions)
    for (const std::string& text : {c.time, c.x[0], c.x[1], c.v[0], c.v[1]}) CHECK(std::stod(text) != 0);
  // An orbit along an axis, with a speed that is irrational: y is 0, as far as can be told.
  const Told axis = follow(unit(2, "1/4"), start_at({"1/2", "0"}, {"sqrt(2)", "0"}), journey);
  CHECK(begins(axis.collisions.back().x[1], "0e-"));
  CHECK(std::stod(axis.collisions.back().x[1]) == 0);
  // At a speed of 10^200 that 0 is told to be less than a large number.
  const Told fast = follow(unit(2, "1/3"), start_at({"1/2", "0"}, {"1e200", "sqrt(2)"}), journey);
  const Told nothing = follow(unit(2, "1/3"), start_at({"1/2", "0"}, {"1e200", "0"}), journey);
  for (const Told* told : {&fast, &nothing})
    for (const std::string& text : told->end.v) {
      std::size_t read = 0;
      std::stod(text, &read);
      CHECK(read == text.size());
    }
}

TEST_CASE("Itinerary: a number midway between two decimals has a digit more") {
  const auto x_at = [](const std::string& time, int digits) {
    return follow(unit(2, "1/10"), start_at({"0.5", "1/2"}, {"1", "0"}), until(time, digits)).end.x[0];
  };
  CHECK(x_at("0.123456789012345675", 17) == "0.623456789012345675");
  CHECK(x_at("0.35", 1) == "0.85");
  // 3.0000000000000000 and the like are not midway, and have no digit more.
  CHECK(x_at("2.5", 3) == "3.00");
}

TEST_CASE("Itinerary: whatever the bits, what is said is true") {
  // The challenge at every precision up to the one that it needs: an end, and digits, are right or not there.
  // Times to end next to that of the seventh collision, 5.91119415526806614.., are the hardest.
  const auto told_with = [](long bits, const std::string& time, int digits) {
    oracle::Journey journey = until(time, digits);
    journey.first_bits = journey.most_bits = bits;
    return follow(unit(2, "1/3"), start_at({"1/2", "1/10"}, {"1", "0"}), journey).end;
  };
  std::size_t said = 0;
  for (const std::string time : {"10", "5.91119415", "5.91119416", "5.911194155268", "5.911194155269"})
    for (const int digits : {1, 4, 9, 17}) {
      const Arrival truth = told_with(600, time, digits);
      for (long bits = 32; bits < 140; ++bits) {
        const Arrival end = told_with(bits, time, digits);
        if (end.end == JourneyEnd::undecided) continue;
        ++said;
        REQUIRE(end.collisions == truth.collisions);
        REQUIRE(end.x == truth.x);
        REQUIRE(end.v == truth.v);
        REQUIRE(end.distance == truth.distance);
      }
    }
  CHECK(said > 500);
}
