// What double-double cannot decide is decided without rounding: whether x lies in an obstacle, whether one is met and
// ahead, which of two comes first, and whether a line stays between two lattice planes for ever.
#include "src/engines/reduction/unrounded.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>

#include <cmath>

#include <lorentz/certified.hpp>
#include <lorentz/geometry.hpp>
#include "src/engines/base/expansion.hpp"
#include "tests/engines/reduction_support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

using Exact = boost::multiprecision::cpp_rational;

Exact slack_of(int dimension, const double (&v)[3], const Wide (&N)[3], const double (&home)[3], double r) {
  Exact d[3], speed2 = 0, across2 = 0;
  for (int k = 0; k < dimension; ++k) {
    d[k] = Exact(N[k].hi) + Exact(N[k].lo) + Exact(home[k]);
    speed2 += Exact(v[k]) * Exact(v[k]);
  }
  for (int i = 0; i < dimension; ++i)
    for (int j = i + 1; j < dimension; ++j) {
      const Exact across = d[i] * Exact(v[j]) - d[j] * Exact(v[i]);
      across2 += across * across;
    }
  return Exact(r) * Exact(r) * speed2 - across2;
}

// A small lattice vector, or a direction a few ulps or 2^-40 to 2^-52 beside it.
Vec near_rational(Draw& draw, int dimension) {
  const auto small = [&] {
    Vec v{};
    while (v == Vec{})
      for (int k = 0; k < dimension; ++k) v[k] = static_cast<double>(draw.below(19)) - 9;
    return v;
  };
  Vec v = small();
  const Vec aside = small();
  const double ulp = 0x1p-52, beside = std::exp2(draw.between(-52, -40));
  const bool jitters = draw.one_in(2);
  for (int k = 0; k < dimension; ++k)
    v[k] += jitters ? v[k] * ulp * (static_cast<double>(draw.below(7)) - 3) : beside * aside[k];
  return v;
}

Count near_rational_campaign(std::uint64_t seed, int dimension, double r, long cases) {
  Draw draw(seed);
  Count count;
  const Scene scene = unit_scene(dimension, r);
  for (long i = 0; i < cases; ++i)
    check(scene, {draw.vec(dimension, 0, 1), near_rational(draw, dimension), {}}, count);
  return count;
}

}  // namespace

TEST_CASE("A sum without rounding has the sign and the size of the exact one", "[engines][unrounded]") {
  Draw draw(20261129);
  for (int i = 0; i < 20'000; ++i) {
    Expansion sum;
    Exact exact = 0;
    for (int k = 0; k < 12; ++k) {
      const double a = draw.between(-1, 1) * std::exp2(static_cast<double>(draw.below(200)) - 100), b = -a;
      for (const double part : {a, draw.one_in(2) ? b : std::nextafter(b, 0)})
        sum.add(part), exact += Exact(part);
      const double x = draw.between(-1, 1), y = draw.between(-1, 1);
      sum.add_product(Expansion(x), Expansion(y));
      exact += Exact(x) * Exact(y);
    }
    REQUIRE(sum.is_exact());
    REQUIRE(abs(Exact(sum.value()) - exact) <= Exact(4 * kRoundoff) * abs(exact));
    sum.add(-sum.value());
    REQUIRE(sum.is_zero() == (sum.value() == 0));
  }
}

TEST_CASE("The slack of a far ball is right at the boundary", "[engines][unrounded]") {
  Draw draw(20261130);
  int met = 0, missed = 0;
  for (int i = 0; i < 20'000; ++i) {
    const int dimension = 2 + static_cast<int>(draw.below(2));
    const Vec w = near_rational(draw, dimension);
    double v[3] = {}, home[3] = {};
    Wide N[3] = {Wide(0), Wide(0), Wide(0)};
    const double far = std::exp2(draw.between(0, 58));
    for (int k = 0; k < dimension; ++k) {
      v[k] = w[k] / 16;
      N[k] = Wide(std::nearbyint(far * v[k]), static_cast<double>(draw.below(3)) - 1);
      home[k] = draw.between(-0.5, 0.5);
    }
    // The radius within a few ulps of the distance at which the line passes.
    const Exact at_0 = slack_of(dimension, v, N, home, 0), unit = slack_of(dimension, v, N, home, 1) - at_0;
    const double passed = std::sqrt(static_cast<double>(Exact(-at_0 / unit)));
    const double r = passed * (1 + (static_cast<double>(draw.below(5)) - 2) * 0x1p-53);
    const Exact exact = slack_of(dimension, v, N, home, r);
    double error;
    const double slack = close_slack(v, N, {home[0], home[1], home[2]}, r, error);
    REQUIRE(abs(Exact(slack) - exact) <= Exact(error));
    REQUIRE(error < 0x1p-90);
    (slack > error ? met : missed) += std::fabs(slack) > error;
  }
  CHECK((met > 5000 && missed > 5000));
}

TEST_CASE("A slack of one square of the roundoff has its sign", "[engines][unrounded]") {
  // Pell's equation: 2 m^2 - k^2 is 1 and -1 in turn, so that r = m / 2^53 and |v x d| = k / 2^53 give 2^-106.
  bool meets = true;
  for (double k = 1, m = 1; k < 0x1p51; meets = !meets) {
    const double below = k * 0x1p-53;
    Scene scene = unit_scene(3, m * 0x1p-53);
    const Query query{{-0.25, -0.25 - below, 0}, {1, 1, 0}, {}};
    INFO(stream(scene, query));
    if (m > 0x1p31) CHECK(Reduction(scene).fly(query).outcome == (meets ? Outcome::hit : Outcome::never));
    scene.lattices[0].rank = 0, scene.lattices[0].vectors = {};
    CHECK(Reduction(scene).fly(query).outcome == (meets ? Outcome::hit : Outcome::never));
    const double next = m + k;
    k += 2 * m, m = next;
  }
}

// In units of 1/16, along vectors of integer length: lines touch balls, starts lie on surfaces, and obstacles are
// entered at once; so do ellipsoids, balls in other coordinates.
TEST_CASE("Tangents, starts on surfaces and ties are decided", "[engines][unrounded]") {
  Draw draw(20'261'130);
  const std::vector<Vec> plane{{1, 0}, {0, 1}, {3, 4}, {-4, 3}, {5, -12}, {-8, -15}},
      space{{1, 0, 0}, {0, 0, -1}, {1, 2, 2}, {-2, 1, 2}, {2, -3, 6}, {3, 4, 0}};
  const auto sixteenths = [&](int dimension, int most) {
    Vec x{};
    for (int k = 0; k < dimension; ++k) x[k] = (static_cast<double>(draw.below(2 * most + 1)) - most) / 16;
    return x;
  };
  for (const char* kind : {"unit", "one atom", "several", "overlapping", "ellipsoids", "rows and layers"}) {
    Count count;
    for (int i = 0; i < 4000; ++i) {
      const int dimension = 2 + static_cast<int>(draw.below(2));
      Scene scene = unit_scene(dimension, (1 + static_cast<double>(draw.below(8))) / 16);
      Lattice& lattice = scene.lattices[0];
      const std::string_view is = kind;
      if (is == "overlapping") lattice.atoms[0].radius *= 2;
      if (is != "unit") lattice.atoms[0].position = sixteenths(dimension, 8), lattice.vectors[1][0] = 0.25;
      if (is == "several") lattice.atoms.push_back({sixteenths(dimension, 8), 0.3125, {}});
      if (is == "rows and layers") lattice.rank = dimension - 1, lattice.vectors[dimension - 1] = {};
      if (is == "ellipsoids")
        for (Atom& atom : lattice.atoms) {
          for (int k = 0; k < dimension; ++k) atom.semiaxes.push_back({}), atom.semiaxes[k][k] = atom.radius;
          atom.semiaxes[0][1] = atom.radius / 2, atom.radius = 0;
        }
      Query query{sixteenths(dimension, 32), (dimension == 2 ? plane : space)[draw.below(6)], {}};
      if (!Reduction::beyond(scene)) check(scene, query, count);
    }
    INFO(kind);
    const bool is_sparse = std::string_view(kind) == "rows and layers";  // not along a layer
    CHECK(count.stages.double_double > (is_sparse ? 30 : 100));          // 49, 111 to 393 seen
    CHECK(count.stages.undecided < (is_sparse ? 100 : 1));               // 76, 0 seen
  }
}

TEST_CASE("A limit at the very time of entry is later", "[engines][unrounded]") {
  Scene ball = unit_scene(3, 0.25), ellipse = unit_scene(2, 1), single = unit_scene(2, 0.25);
  ellipse.lattices[0].atoms[0] = {{}, 0, {Vec{0.25, 0, 0}, Vec{0.125, 0.375, 0}}};
  single.lattices[0].rank = 0, single.lattices[0].vectors = {};
  for (const Scene& scene : {ball, ellipse, single})
    for (const double speed : {1.0, 3.0, 0x1p-700, 0x1p700})
      for (const double x : {-0.5, -0.75}) {
        const Query query{{x, 0, 0}, {speed, 0, 0}, {}};
        INFO(stream(scene, query));
        const Reduction engine(scene);
        // An ellipse's boundary meets its first axis where the other semiaxis does not count.
        const double exact = *oracle::Oracle(scene).first_hit(query).time, distance = -x - 0.25;
        if (exact * speed != distance) continue;
        CHECK(engine.fly(query, exact).outcome == Outcome::later);
        CHECK(engine.fly(query, std::nextafter(exact, HUGE_VAL)).outcome == Outcome::hit);
        CHECK(engine.fly(query, std::nextafter(exact, 0)).outcome == Outcome::later);
      }
  const Query inwards{{0.25, 0, 0}, {-1, 0, 0}, {}};  // on the surface: at once
  for (const double limit : {5e-324, 1e-300, 1e-17, 1.0})
    CHECK(Reduction(ball).fly(inwards, limit).outcome == Outcome::hit);
}

TEST_CASE("No time is below zero, not even by a rounding", "[engines][unrounded]") {
  Scene upright = unit_scene(2, 1), turned = upright;
  upright.lattices[0].atoms[0] = {{0, 0.5, 0}, 0, {Vec{-0.3125, -0.9375, 0}, Vec{0.3125, 0, 0}}};
  turned.lattices[0].vectors = {Vec{0.6, 0.8, 0}, Vec{-0.8, 0.6, 0}};
  turned.lattices[0].atoms[0] = {
      {0.8798076923076923, -0.2692307692307692, 0}, 0, {Vec{0.3125, 0, 0}, Vec{0, 0.5625, 0}}};
  for (const double speed : {1.0, 0x1p-1074}) {
    const Flight flight = Reduction(upright).fly({{-0.3125, -2.4375, 0}, {0, speed, 0}, {}});
    CHECK((flight.outcome == Outcome::hit && flight.time == 0 && !std::signbit(flight.time)));
  }
  const Query start{{1, 0.25, 0}, {0.29862431272128587, -0.7538574152266032, 0}, {}};
  CHECK(Reduction(turned).fly(start).time >= 0);
}

TEST_CASE("A line between two lattice planes is told from one that meets their balls by a hair",
          "[engines][unrounded]") {
  // Along (7, 6, 5) but for ulps of (1, 2, -2): in planes of the normal (-22, 19, 8), whose length is 30.15.
  const double v[3] = {7 + 0x1p-50, 6 + 0x1p-49, 5 - 0x1p-49};
  const Vec home{0, 0, 0.125 / 8};
  const double reach = 0.125 / std::sqrt(22. * 22 + 19 * 19 + 8 * 8);
  CHECK(stays_between_planes(v, home, reach * (1 - 1e-9)));
  CHECK_FALSE(stays_between_planes(v, home, reach * (1 + 1e-9)));
  const double parallel[3] = {7, 6, 5};
  CHECK_FALSE(stays_between_planes(parallel, home, reach / 2));  // along a line of balls: any plane
  CHECK_FALSE(stays_between_planes({3.141592653589793, 2.718281828459045, 1.4142135623730951}, home,
                                   reach / 2));  // in no plane of short vectors
}

TEST_CASE("A line in a plane of given lattice vectors is told from one beside it", "[engines][unrounded]") {
  // The planes of a = (3001, 7, 0) and b = (0, 1, 2011), whose normal is (7 2011, -3001 2011, 3001).
  const Vec a{3001, 7, 0}, b{0, 1, 2011}, home{0, 0, 0x1p-18};
  const double v[3] = {2 * 3001, 2 * 7 + 3, 3 * 2011}, off[3] = {2 * 3001, 2 * 7 + 3, 3 * 2011 + 0x1p-37};
  const double size = std::hypot(7. * 2011, 3001. * 2011, 3001.), reach = 3001 * 0x1p-18 / size;
  CHECK(stays_between_planes(v, home, reach * (1 - 1e-9), a, b));
  CHECK_FALSE(stays_between_planes(v, home, reach * (1 + 1e-9), a, b));
  CHECK_FALSE(stays_between_planes(off, home, reach / 2, a, b));
  CHECK_FALSE(stays_between_planes(v, home, reach / 2, a, a));
}

TEST_CASE("Places and v x d err by a few roundoffs, where large terms cancel", "[engines][unrounded]") {
  Draw draw(20261130);
  int cancelled = 0;
  const double u2 = kCross * kRoundoff * kRoundoff;
  for (int i = 0; i < 20000; ++i) {
    const Vec w = near_rational(draw, 3);
    double v[3] = {std::fabs(w[0]), std::fabs(w[1]), std::fabs(w[2])};
    if (draw.one_in(4)) v[draw.below(3)] = draw.between(0x1p-60, 0x1p-50);  // 61 bits do not hold all three
    const bool follows = draw.one_in(4);  // the cell is the nearest to a place on the line
    if (follows) v[draw.below(3)] = draw.between(0x1p-20, 0x1p-10);
    std::sort(v, v + 3, std::greater<>());
    const Vec home = draw.vec(3, -0.5, 0.5);
    const double steps = std::nearbyint(std::exp2(draw.between(0, 72))), begin = draw.one_in(2) ? 0 : 0x1p40;
    Wide N[3];
    Exact d[3], speed[3];
    for (int k = 0; k < 3; ++k) {
      N[k] = Wide::product(steps, std::nearbyint(v[k])) + Wide(static_cast<double>(draw.below(9)) - 4);
      if (const Wide place = Wide::product(steps, v[k]); follows)
        N[k] = Wide::sum(std::nearbyint(place.hi), std::nearbyint(place.lo));
      d[k] = Exact(N[k].hi) + Exact(N[k].lo) + Exact(home[k]), speed[k] = Exact(v[k]);
    }
    Wide cross[3], along;
    Vec place;
    REQUIRE(set_cross(v, N, home, cross, &along));
    unrounded_place(v, N, home, begin, place);
    const double of_home =
        std::hypot(v[0], v[1], v[2]) * (std::hypot(home[0], home[1], home[2]) + kFromOrigin);
    const auto is_near = [&](const Exact& value, const Exact& exact, double own, double granted) {
      return abs(value - exact) <= Exact(own) * abs(exact) + Exact(granted);
    };
    const auto exact_of = [](const Wide& a) { return Exact(a.hi) + Exact(a.lo); };
    double size = of_home;
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      REQUIRE(is_near(exact_of(cross[k]), speed[l] * d[m] - speed[m] * d[l], u2, u2 * of_home));
      size += std::fabs(cross[k].hi);
    }
    const Exact level = speed[0] * d[0] + speed[1] * d[1], whole = level + speed[2] * d[2];
    REQUIRE(is_near(exact_of(along), whole, u2, u2 * of_home));
    const Exact across = (speed[0] * speed[0] + speed[1] * speed[1]) * d[2] - speed[2] * level;
    const double own = kUnroundedPlace * kRoundoff;
    REQUIRE(is_near(Exact(place[0]), speed[0] * d[1] - speed[1] * d[0], own, u2 * of_home));
    REQUIRE(is_near(Exact(place[1]), across, own, 2 * u2 * (v[0] + v[1]) * size));
    REQUIRE(is_near(Exact(place[2]), whole - Exact(begin), own, u2 * (of_home + std::fabs(along.hi))));
    cancelled += std::fabs(place[0]) < 0x1p-20 * steps;
  }
  CHECK(cancelled > 5000);
  Wide cross[3];
  CHECK(set_cross({1, 1, 1}, {0x1p75, 0x1p75, 0x1p75}, {}, cross, nullptr));
  CHECK_FALSE(set_cross({1, 1, 1}, {0x1p76, 0x1p76, 0x1p76}, {}, cross, nullptr));
  CHECK_FALSE(set_cross({1, 1, 1}, {0x1p75, 0x1p75, 0}, {}, cross, nullptr));  // leaves 128 bits
}

TEST_CASE("Near-rational flights are decided, nearly all of them, and rightly", "[engines][unrounded]") {
  const auto undecided = [](int dimension, double r) {
    const Count count = near_rational_campaign(20261129, dimension, r, 1500);
    return static_cast<double>(count.stages.undecided) / static_cast<double>(count.cases);
  };
  for (const double r : {0.1, 1e-3, 1e-6}) CHECK(undecided(2, r) == 0);
  CHECK(undecided(3, 0.1) < 0.002);
  CHECK(undecided(3, 1e-3) < 0.005);
  CHECK(undecided(3, 1e-6) < 0.05);  // hits in cells that 64 bits do not hold, nearly all of them
}

TEST_CASE("Hits in cells that 64 bits do not hold are named, and rightly", "[engines][unrounded]") {
  const Scene scene = unit_scene(3, 1e-6);
  const Reduction engine(scene);
  const oracle::Certified certified(scene);
  const oracle::Oracle exact(scene);
  Draw draw(20261201);
  int far = 0, undecided = 0;
  for (int i = 0; i < 4000; ++i) {
    Query query;
    query.x = draw.vec(3, 0, 1), query.v = near_rational(draw, 3);
    const Answer answer = engine.first_hit(query);
    undecided += answer.outcome == Outcome::undecided;
    if (answer.outcome != Outcome::hit || answer.obstacle.cell[0].fits_int64()) continue;
    ++far;
    INFO(stream(scene, query));
    const Answer right = exact.first_hit(query);
    REQUIRE(answer.obstacle == right.obstacle);
    REQUIRE(same(certified.first_hit(query), right));
    REQUIRE(engine.fly(query).outcome == Outcome::undecided);
    query.from = right.obstacle;  // is passed over, far as it is
    const Answer next = engine.first_hit(query);
    if (next.outcome != Outcome::undecided) REQUIRE(next.obstacle == exact.first_hit(query).obstacle);
    REQUIRE(same(certified.first_hit(query), exact.first_hit(query)));
  }
  CHECK(far > 50);
  CHECK(undecided < 20);
}
