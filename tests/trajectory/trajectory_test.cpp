// One particle from collision to collision.
#include <lorentz/trajectory.hpp>

#include <catch2/catch.hpp>
#include <cmath>

#include <lorentz/geometry.hpp>
#include <lorentz/itinerary.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/reduction.hpp>
#include <lorentz/trajectory_batch.hpp>
#include "src/trajectory/meeting.hpp"
#include "statistics/rival/rival.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

constexpr double kForEver = HUGE_VAL;

bool go_on(const Trajectory&) {
  return true;
}

std::array<std::int64_t, 3> cell_of(const Trajectory& trajectory) {
  return trajectory.state().cell;
}

Scene ellipses(double scale) {
  Scene scene = unit_scene(2, 1);
  scene.lattices[0].atoms = {
      {{0.01, 0, 0}, 0, {{0.9 * scale, 0.2 * scale, 0}, {-0.1 * scale, 0.5 * scale, 0}}},
      {{0.47, 0.02, 0}, 0.1 * scale, {}}};
  return scene;
}

Scene ellipsoids() {
  Scene scene = unit_scene(3, 1);
  scene.lattices[0].atoms = {{{}, 0, {{0.3, 0, 0.05}, {0.02, 0.2, 0}, {0, 0.04, 0.25}}}};
  return scene;
}

// |A^-1 offset|: 1 on the surface.
double height(const Scene& scene, const Particle& particle) {
  const Atom& atom = scene.lattices[particle.lattice].atoms[particle.atom];
  return length(coordinates(dual_of(semiaxes_of(atom, scene.dimension), scene.dimension), particle.offset));
}

}  // namespace

// ---- known answers

TEST_CASE("Problem 2 of the 100-digit challenge: the digits that each precision has", "[trajectory]") {
  // Discs of radius 1/3, from (1/2, 1/10) due east, both rounded to binary64; the distance at t = 10 of these
  // numbers, taken exactly, by decimal arithmetic of 100 digits.
  const Scene scene = unit_scene(2, 1.0 / 3);
  const Reduction engine(scene);
  const std::vector<std::array<std::int64_t, 3>> discs{{1, 0},  {-1, 1},  {0, 2},  {0, 1},  {-1, 2},
                                                       {0, 0},  {-1, 0},  {0, 1},  {0, 0},  {-1, 0},
                                                       {0, -1}, {-1, -1}, {-1, 0}, {-1, -1}};
  for (const Precision precision : {Precision::binary64, Precision::double_double}) {
    Trajectory trajectory(engine, scene, {{0.5, 0.1, 0}, {1, 0, 0}, {}}, precision);
    std::vector<std::array<std::int64_t, 3>> seen;
    const Stop stop = trajectory.run(1000, 10, [&](const Trajectory& now) {
      seen.push_back(cell_of(now));
      return true;
    });
    CHECK(stop == Stop::time);
    CHECK(trajectory.state().time == 10);
    CHECK(seen == discs);
    const Vec place = trajectory.place();
    const double error = std::fabs(std::hypot(place[0], place[1]) - 0.99526213359997041031848927928518);
    CHECK(error < (precision == Precision::binary64 ? 2e-5 : 1e-14));  // seen: 4.3e-7, below 2e-16
  }
}

TEST_CASE("A particle between two discs, head-on, leaves its line at the known rate", "[trajectory]") {
  // From the middle between discs at distance L, a little off the line of their centres: each collision
  // multiplies the angle by L / r - 1 + (L / r) sqrt(1 - 2 r / L), once the stable part is gone.
  for (const double r : {0.1, 0.3, 0.45}) {
    const Scene scene = unit_scene(2, r);
    const Reduction engine(scene);
    Trajectory trajectory(engine, scene, {{0.5, 0, 0}, {1, 1e-22, 0}, {}}, Precision::double_double);
    const double multiplier = 1 / r - 1 + std::sqrt(1 - 2 * r) / r;
    double angle = 0;
    while (std::fabs(trajectory.state().velocity[1]) < 1e-9) {
      angle = trajectory.state().velocity[1];
      REQUIRE(trajectory.advance());
    }
    CHECK(std::fabs(trajectory.state().velocity[1] / angle) == Approx(multiplier).epsilon(1e-8));
  }
}

TEST_CASE("Inside the plane of two foci an ellipse's reflections keep the product of angular momenta",
          "[trajectory]") {
  // A reflection at one ellipse with the foci +-f keeps the product of the angular momenta about the foci,
  // whichever side it is on. Semiaxes 0.3 and 0.2.
  Scene scene = unit_scene(2, 1);
  scene.lattices[0].atoms = {{{}, 0, {{0.3, 0, 0}, {0, 0.2, 0}}}};
  const double f = std::sqrt(0.09 - 0.04);
  const Reduction engine(scene);
  const auto product = [&](const Vec& x, const Vec& v) {
    return ((x[0] - f) * v[1] - x[1] * v[0]) * ((x[0] + f) * v[1] - x[1] * v[0]);
  };
  Trajectory trajectory(engine, scene, {{0.5, 0.45, 0}, {0.6, 0.37, 0}, {}});
  for (int i = 0; i < 10'000; ++i) {
    REQUIRE(trajectory.advance());
    const Particle& now = trajectory.state();
    CHECK(product(now.offset, now.velocity) ==
          Approx(product(now.offset, trajectory.collision().arriving)).epsilon(0).margin(1e-15));
  }
}

// ---- what is kept

TEST_CASE("Speed and surface are kept over many collisions", "[trajectory]") {
  for (const Precision precision : {Precision::binary64, Precision::double_double})
    for (const Scene& scene : {unit_scene(2, 0.2), unit_scene(2, 1e-5), unit_scene(3, 0.2),
                               unit_scene(3, 1e-3), ellipses(0.3), ellipsoids(), two_lattices()}) {
      const Reduction engine(scene);
      Draw draw(5);
      Trajectory trajectory(engine, scene, start_between(draw, scene.dimension), precision);
      const double speed = length(trajectory.state().velocity);
      double worst_speed = 0, worst_height = 0;
      const Stop stop = trajectory.run(20'000, kForEver, [&](const Trajectory& now) {
        worst_speed = std::max(worst_speed, std::fabs(length(now.state().velocity) / speed - 1));
        worst_height = std::max(worst_height, std::fabs(height(scene, now.state()) - 1));
        return true;
      });
      REQUIRE(stop == Stop::collisions);
      CHECK(worst_speed < 8 * 0x1p-53);
      CHECK(worst_height < 16 * 0x1p-53);
    }
}

TEST_CASE("Times add up without loss", "[trajectory]") {
  const Scene scene = unit_scene(2, 0.2);
  const Reduction engine(scene);
  Draw draw(13);
  Trajectory trajectory(engine, scene, start_between(draw, 2));
  long double sum = 0;  // of 64 bits
  trajectory.run(100'000, kForEver, [&](const Trajectory& now) {
    sum += now.collision().flight;
    return true;
  });
  const Particle& now = trajectory.state();
  CHECK(now.time_low != 0);
  CHECK(std::fabs(now.time_low) <= std::ldexp(now.time, -53));
  CHECK(std::fabs(static_cast<double>(sum - now.time - now.time_low)) < std::ldexp(now.time, -57));
}

TEST_CASE("A collision is the oracle's, as exact as the state", "[trajectory]") {
  // The flight of each state is asked again, exactly, in the frame of the obstacle that it leaves.
  Draw draw(7);
  for (const Scene& scene :
       {unit_scene(2, 0.3), unit_scene(2, 1e-3), unit_scene(3, 0.1), ellipses(0.3), ellipsoids()}) {
    const oracle::Oracle oracle(scene);
    for (const char* name : {"reduction", "classical", "published"}) {
      const bool is_hard = scene.dimension == 3 || !scene.lattices[0].atoms[0].is_ball();
      if (is_hard && std::string(name) == "published") continue;  // often wrong there
      const auto engine = make_engine(name, scene);
      for (const Precision precision : {Precision::binary64, Precision::double_double}) {
        Trajectory trajectory(*engine, scene, start_between(draw, scene.dimension), precision);
        trajectory.advance();
        if (trajectory.stop() == Stop::error) continue;  // beyond this engine
        for (int i = 0; i < 40; ++i) {
          const Particle before = trajectory.state();
          const Query query{sum(scene.lattices[0].atoms[before.atom].position, before.offset),
                            before.velocity, ObstacleId{0, before.atom, {}}};
          const Answer answer = oracle.first_hit(query);
          REQUIRE(trajectory.advance());
          const Particle& now = trajectory.state();
          REQUIRE(answer.outcome == Outcome::hit);
          CHECK(now.atom == answer.obstacle.atom);
          for (int k = 0; k < 3; ++k) CHECK(now.cell[k] - before.cell[k] == answer.obstacle.cell[k].int64());
          // Near-grazing arrivals have times that a state's last bit moves by more.
          const double slack = 0x1p-49 * (1 + *answer.time) / trajectory.collision().cosine;
          CHECK(trajectory.collision().flight == Approx(*answer.time).epsilon(0).margin(slack));
        }
      }
    }
  }
}

TEST_CASE("A collision in binary64 is that in double-double, rounded", "[trajectory]") {
  Draw draw(29);
  for (const Scene& scene : {unit_scene(2, 0.3), unit_scene(2, 1e-4), unit_scene(3, 0.1), unit_scene(3, 1e-2),
                             ellipses(0.3), ellipsoids(), two_lattices()}) {
    const Reduction engine(scene);
    const Query start = start_between(draw, scene.dimension);
    Trajectory rough(engine, scene, start), fine(engine, scene, start, Precision::double_double);
    double least = HUGE_VAL;
    for_each_atom(scene, [&](const Atom& atom) {
      for (int i = 0; i < scene.dimension; ++i)
        least = std::min(least, length(semiaxes_of(atom, scene.dimension)[i]));
    });
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
      fine.set_state(rough.state());
      REQUIRE(rough.advance());
      REQUIRE(fine.advance());
      const Particle &a = rough.state(), &b = fine.state();
      const double speed = length(b.velocity), unit = 0x1p-53 / fine.collision().cosine;
      const double way = fine.collision().flight * speed + 1;
      worst = std::max(worst, length(sum(a.offset, scaled(b.offset, -1))) / (unit * way));
      worst = std::max(worst, length(sum(a.velocity, scaled(b.velocity, -1))) / (unit * way / least * speed));
    }
    CHECK(worst < 16);
  }
}

TEST_CASE("A collision with the smallest obstacles is the certified one, too", "[trajectory]") {
  // In binary64 nothing of the place would be left: a flight is up to 10^24 times the radius.
  Draw draw(31);
  for (const Scene& scene :
       {unit_scene(2, 1e-4), unit_scene(2, 1e-6), unit_scene(2, 1e-9), unit_scene(2, 1e-12),
        unit_scene(3, 1e-3), unit_scene(3, 1e-5), unit_scene(3, 1e-7), ellipses(1e-8)}) {
    const Reduction engine(scene);
    const oracle::Itinerary itinerary(rational(scene));
    for (int i = 0; i < 60; ++i) {
      Trajectory trajectory(engine, scene, start_between(draw, scene.dimension));
      REQUIRE(trajectory.advance());
      const Particle before = trajectory.state();
      REQUIRE(trajectory.advance());
      const Vec x = sum(scene.lattices[0].atoms[before.atom].position, before.offset);
      Start start;
      start.from = ObstacleId{0, before.atom, {}};
      for (int k = 0; k < 3; ++k) start.x[k] = x[k], start.v[k] = Surd(Rational(before.velocity[k]));
      oracle::Journey one;
      one.collisions = 1;
      oracle::CertifiedCollision truth;
      itinerary.follow(start, one, [&](const oracle::CertifiedCollision& told) {
        truth = told;
        return true;
      });
      const Particle& now = trajectory.state();
      REQUIRE(now.atom == truth.obstacle.atom);
      for (int k = 0; k < 3; ++k) REQUIRE(now.cell[k] - before.cell[k] == truth.obstacle.cell[k].int64());
      const double u = 0x1p-20 / trajectory.collision().cosine, size = length(truth.offset);
      CHECK(length(sum(now.offset, scaled(truth.offset, -1))) < u * size);
      CHECK(length(sum(now.velocity, scaled(truth.velocity, -1))) < 8 * u * length(truth.velocity));
    }
  }
}

TEST_CASE("Superposed lattices: a particle ends where an ulp of its place is too much", "[trajectory]") {
  const auto stop_among = [](double radius) {
    Scene scene = two_lattices();
    scene.lattices[0].atoms[0].radius = scene.lattices[1].atoms[0].radius = radius;
    const Reduction engine(scene);
    return Trajectory(engine, scene, {{0.31, 0.23, 0}, {1, 0.4142, 0}, {}}).run(200, HUGE_VAL, go_on);
  };
  CHECK(stop_among(1e-3) == Stop::collisions);
  CHECK(stop_among(1e-8) == Stop::overflow);
}

TEST_CASE("Far from the origin a trajectory is the same, to the bit", "[trajectory]") {
  for (const Scene& scene : {unit_scene(2, 0.2), unit_scene(3, 0.2), ellipses(0.3)}) {
    const Reduction engine(scene);
    const Query here{{0.25, 0.0625, 0}, {0.3, -0.7, scene.dimension == 3 ? 0.4 : 0}, ObstacleId{}};
    Query there = here;
    there.from->cell = {std::int64_t{1} << 40, -(std::int64_t{1} << 41), scene.dimension == 3 ? 7 : 0};
    Trajectory near(engine, scene, here), far(engine, scene, here);
    Particle moved = far.state();
    for (int k = 0; k < 3; ++k) moved.cell[k] = there.from->cell[k].int64();
    far.set_state(moved);
    for (int i = 0; i < 1000; ++i) {
      REQUIRE(near.advance());
      REQUIRE(far.advance());
      REQUIRE(near.state().offset == far.state().offset);
      REQUIRE(near.state().velocity == far.state().velocity);
      for (int k = 0; k < 3; ++k)
        REQUIRE(far.state().cell[k] - near.state().cell[k] == there.from->cell[k].int64());
    }
  }
}

TEST_CASE("Another basis, or another origin, gives the same itinerary while digits last", "[trajectory]") {
  const Scene scene = unit_scene(2, 0.3);
  Scene sheared = scene, moved = scene;
  sheared.lattices[0].vectors = {Vec{1, 0, 0}, {5, 1, 0}};
  moved.lattices[0].atoms[0].position = {0.625, -0.25, 0};
  const Reduction one(scene), two(sheared), three(moved);
  Draw draw(3);
  for (int i = 0; i < 20; ++i) {
    const Query start = start_between(draw, 2);
    Query shifted = start;
    shifted.x = sum(start.x, moved.lattices[0].atoms[0].position);
    for (int k = 0; k < 2; ++k) shifted.x[k] = std::round(shifted.x[k] * 0x1p40) * 0x1p-40;
    Query rounded = start;
    for (int k = 0; k < 2; ++k) rounded.x[k] = shifted.x[k] - moved.lattices[0].atoms[0].position[k];
    Trajectory a(one, scene, rounded, Precision::double_double),
        b(two, sheared, rounded, Precision::double_double),
        c(three, moved, shifted, Precision::double_double);
    for (int n = 0; n < 15; ++n) {  // 37 bits are lost in 14
      REQUIRE(a.advance());
      REQUIRE(b.advance());
      REQUIRE(c.advance());
      CHECK(cell_of(b)[0] + 5 * cell_of(b)[1] == cell_of(a)[0]);
      CHECK(cell_of(b)[1] == cell_of(a)[1]);
      CHECK(cell_of(c) == cell_of(a));
    }
  }
}

TEST_CASE("Turned round, a particle finds back to its start", "[trajectory]") {
  for (const Scene& scene : {unit_scene(2, 0.3), unit_scene(3, 0.3), ellipses(0.3)}) {
    const Reduction engine(scene);
    Draw draw(17);
    const Query start = start_between(draw, scene.dimension);
    Trajectory trajectory(engine, scene, start, Precision::double_double);
    REQUIRE(trajectory.run(1000, 6, go_on) == Stop::time);
    Particle back = trajectory.state();
    for (int k = 0; k < 3; ++k) back.velocity[k] *= -1, back.velocity_low[k] *= -1;
    back.leaves = false;  // it comes to the obstacle that it left
    trajectory.set_state(back);
    REQUIRE(trajectory.run(1000, 12, go_on) == Stop::time);
    for (int k = 0; k < 3; ++k) CHECK(trajectory.place()[k] == Approx(start.x[k]).epsilon(0).margin(1e-13));
  }
}

// ---- ends

TEST_CASE("At a time that is asked for a particle is where it is then, and goes on from there",
          "[trajectory]") {
  for (const Scene& scene : {unit_scene(2, 0.3), unit_scene(3, 0.3), two_lattices()}) {
    Draw draw(19);
    const Query start = start_between(draw, scene.dimension);
    for (const char* name : {"reduction", "classical"}) {
      const auto engine = make_engine(name, scene);
      Trajectory straight(*engine, scene, start, Precision::double_double),
          halting(*engine, scene, start, Precision::double_double),
          hurried(*engine, scene, start, Precision::double_double);
      for (int n = 0; n < 12; ++n) {
        REQUIRE(straight.advance());
        const double time = straight.state().time, flight = straight.collision().flight;
        // Twice on the way, and a little before it is there.
        for (const double until : {time - 0.7 * flight, time - 0.3 * flight, time - 1e-9}) {
          const Vec before = halting.place();
          const double left = until - halting.state().time;
          REQUIRE_FALSE(halting.advance(until));
          REQUIRE(halting.stop() == Stop::time);
          CHECK(halting.state().time == until);
          for (int k = 0; k < 3; ++k)
            CHECK(halting.place()[k] ==
                  Approx(before[k] + left * halting.state().velocity[k]).epsilon(0).margin(1e-13));
        }
        CHECK(halting.state().collisions == static_cast<std::uint64_t>(n));
        REQUIRE(halting.advance(time + 1e-9));
        CHECK(cell_of(halting) == cell_of(straight));
        CHECK(halting.state().time == Approx(time).epsilon(0).margin(1e-12));
        if (n < 2) {  // not many of the 106 bits are lost yet
          const Particle &a = halting.state(), &b = straight.state();
          for (int k = 0; k < 3; ++k)
            CHECK(std::fabs((a.offset[k] - b.offset[k]) + (a.offset_low[k] - b.offset_low[k])) < 1e-26);
          CHECK(std::fabs((a.time - b.time) + (a.time_low - b.time_low)) < 1e-26);
        }
        // A collision just before the time is made, and is the same.
        REQUIRE(hurried.advance(time * (1 + 0x1p-52)));
        CHECK(cell_of(hurried) == cell_of(straight));
        CHECK(hurried.state().offset == straight.state().offset);
      }
    }
  }
}

TEST_CASE("A collision exactly at the time asked for is made, one an ulp later is not", "[trajectory]") {
  // Head-on, from surface to surface: at 0.25, 0.75, 1.25 and 1.75.
  Scene superposed = unit_scene(2, 0.25);
  superposed.lattices.push_back({{Vec{1, 0, 0}, {0, 2, 0}}, {{{0, 1, 0}, 0.125, {}}}});
  for (const Scene& scene : {unit_scene(2, 0.25), unit_scene(3, 0.25), superposed})
    for (const Precision precision : {Precision::binary64, Precision::double_double})
      for (const int n : {0, 1, 3})
        for (const bool late : {false, true}) {
          const Batch engine(scene);
          const auto classical = make_engine("classical", scene);
          const Query start{{0.5, 0, 0}, {-1, 0, 0}, {}};
          Trajectory alone(engine.one_at_a_time(), scene, start, precision),
              walked(*classical, scene, start, precision);
          Particles together(engine, scene, precision);
          together.add(start), together.add(start);
          const auto visit = [](std::size_t, const Particle&, const Collision&) { return true; };
          for (int before = 0; before < n; ++before) {
            REQUIRE(alone.advance());
            REQUIRE(walked.advance());
            REQUIRE(together.advance(kForEver, visit) == 2);
          }
          const double time = 0.25 + 0.5 * n, until = late ? std::nextafter(time, 0) : time;
          INFO("collision " << n << " at " << time << ", until " << until);
          CHECK(alone.advance(until) == !late);
          CHECK(walked.advance(until) == !late);
          CHECK(together.advance(until, visit) == (late ? 0 : 2));
          for (const Particle& now : {alone.state(), walked.state(), together[0], together[1]}) {
            CHECK(now.time == until);
            CHECK(now.collisions == static_cast<std::uint64_t>(n + !late));
            CHECK(now.velocity[0] == ((n % 2 == 0) == late ? -1 : 1));
          }
        }
}

TEST_CASE("A trajectory that ends says why", "[trajectory]") {
  const Scene scene = unit_scene(2, 0.1);
  const Reduction engine(scene);
  const auto from = [&](Vec x, Vec v) { return Trajectory(engine, scene, {x, v, {}}); };
  Trajectory never = from({0, 0.5, 0}, {1, 0, 0});
  CHECK_FALSE(never.advance());
  CHECK(never.stop() == Stop::never);
  CHECK_FALSE(never.advance(7.5));
  CHECK(never.stop() == Stop::time);
  CHECK(never.place() == Vec{7.5, 0.5, 0});
  CHECK_FALSE(never.advance(3));  // never back
  CHECK(never.place() == Vec{7.5, 0.5, 0});
  Trajectory inside = from({3.05, 0, 0}, {1, 0, 0});
  CHECK_FALSE(inside.advance());
  CHECK(inside.stop() == Stop::inside);
  Trajectory counted = from({0.5, 0.25, 0}, {0.3, 0.7, 0});
  CHECK(counted.run(5, kForEver, go_on) == Stop::collisions);
  CHECK(counted.state().collisions == 5);
  CHECK(counted.run(9, kForEver, [](const Trajectory& now) { return now.state().collisions < 7; }) ==
        Stop::condition);
  CHECK(counted.state().collisions == 7);
}

TEST_CASE("Whatever an engine says is an end with a name", "[trajectory]") {
  const Scene scene = unit_scene(2, 0.1);
  const Query start{{0.5, 0.5, 0}, {1, 0.001, 0}, {}};
  const auto told = [&](const Answer& answer) {
    Trajectory trajectory([=](const Query&, double, Answer& given) { given = answer; }, scene, start);
    CHECK_FALSE(trajectory.advance());
    CHECK(trajectory.state().collisions == 0);
    return trajectory.stop();
  };
  CHECK(told(Answer::later()) == Stop::later);
  CHECK(told(Answer::undecided()) == Stop::undecided);
  CHECK(told(Answer::error("no")) == Stop::error);
  CHECK(told(Answer::unsupported_because("no")) == Stop::error);
  CHECK(told(Answer::hit({0, 0, {5, 5}}, 1)) == Stop::missed);     // beside the line
  CHECK(told(Answer::hit({0, 0, {-500, 0}}, 1)) == Stop::missed);  // behind
  for (const auto& [lattice, atom] : {std::pair(0, 3), {0, 1}, {0, -1}, {-1, 0}, {1, 0}})
    CHECK(told(Answer::hit({lattice, atom, {1, 0}}, 1)) == Stop::error);  // no such atom
  constexpr std::int64_t kFar = std::int64_t{1} << 53;
  for (const std::int64_t last : {kFar, -kFar}) {  // beside the line, or out of sight
    CHECK(told(Answer::hit({0, 0, {last, 5}}, 1)) == Stop::missed);
    CHECK(told(Answer::hit({0, 0, {last + (last > 0 ? 1 : -1), 5}}, 1)) == Stop::overflow);
  }
  CHECK(told(Answer::hit({0, 0, {*Integer::from_decimal("1" + std::string(30, '0')), 0}}, 1)) ==
        Stop::overflow);
}

TEST_CASE("Atoms are those of the lattice that is named", "[trajectory]") {
  Scene scene = unit_scene(2, 0.1);
  scene.lattices.push_back(scene.lattices[0]);
  for (const int rich : {0, 1}) {
    Scene its = scene;
    its.lattices[rich].atoms.push_back({{0.5, 0.5, 0}, 0.1, {}});
    for (const int lattice : {0, 1}) {
      Trajectory trajectory(
          [=](const Query&, double, Answer& given) {
            given = Answer::hit({lattice, 1, {1, 0}}, 1);
          },
          its, {{0.5, 0.5, 0}, {1, 0, 0}, ObstacleId{rich, 1, {}}});
      CHECK(trajectory.advance() == (lattice == rich));
      CHECK(trajectory.stop() == (lattice == rich ? Stop::none : Stop::error));
    }
  }
}

TEST_CASE("Cells beyond 64 bits are an overflow, and the state stays", "[trajectory]") {
  const Scene scene = unit_scene(2, 0.1);
  const Reduction engine(scene);
  Trajectory trajectory(engine, scene, {{0.25, 0, 0}, {1, 0, 0}, ObstacleId{}});
  Particle far = trajectory.state();
  far.cell[0] = std::numeric_limits<std::int64_t>::max();
  trajectory.set_state(far);
  CHECK_FALSE(trajectory.advance());
  CHECK(trajectory.stop() == Stop::overflow);
  CHECK(trajectory.state().cell == far.cell);
}

TEST_CASE("A line that grazes goes on unchanged", "[trajectory]") {
  // The engine says that a line enters a disc which it touches, or passes by a rounding: so it would be for a
  // state that is a rounding away. A line that passes by more does not meet the disc.
  const Scene scene = unit_scene(2, 0.125);
  const auto engine = [](const Query&, double, Answer& given) { given = Answer::hit({0, 0, {1, 0}}, 0.75); };
  for (const Precision precision : {Precision::binary64, Precision::double_double})
    for (const double above : {0.0, 0x1p-51, 0x1p-40}) {
      const Query start{{0.25, 0.125 + above, 0}, {1, 0, 0}, {}};
      Trajectory trajectory(engine, scene, start, precision);
      CHECK(trajectory.advance() == (above < 0x1p-45));
      CHECK(trajectory.stop() == (above < 0x1p-45 ? Stop::none : Stop::missed));
      if (trajectory.stop() != Stop::none) continue;
      CHECK(trajectory.collision().cosine == 0);
      CHECK(trajectory.state().velocity == start.v);
      CHECK(trajectory.state().offset == Vec{0, 0.125, 0});
      CHECK(trajectory.state().time == 0.75);
    }
}

TEST_CASE("Starts and scenes that no trajectory has are refused", "[trajectory]") {
  const Scene scene = unit_scene(2, 0.1);
  CHECK_THROWS_AS(particle_at(scene, {{0.5, 0.5, 0}, {0, 0, 0}, {}}), InputError);
  CHECK_THROWS_AS(particle_at(scene, {{0.5, 0.5, 0}, {1e200, 0, 0}, {}}), UnsupportedError);
  CHECK_THROWS_AS(particle_at(scene, {{1e30, 0.5, 0}, {1, 0, 0}, {}}), UnsupportedError);
  for (const double end : {0x1p53, -0x1p53}) {
    CHECK_THROWS_AS(particle_at(scene, {{0.5, end, 0}, {1, 0, 0}, {}}), UnsupportedError);
    CHECK(particle_at(scene, {{0.5, std::nextafter(end, 0), 0}, {1, 0, 0}, {}}).cell[1] ==
          static_cast<std::int64_t>(std::nextafter(end, 0)));
  }
  for (const double size : {0x1p-100, 0x1p100}) {  // the ends themselves are in range
    CHECK_NOTHROW(particle_at(scene, {{0.5, 0.5, 0}, {size, 0, 0}, {}}));
    const double beyond = std::nextafter(size, size < 1 ? 0 : HUGE_VAL);
    CHECK_THROWS_AS(particle_at(scene, {{0.5, 0.5, 0}, {beyond, 0, 0}, {}}), UnsupportedError);
  }
  CHECK_THROWS_AS(particle_at(unit_scene(2, 1e-60), {{0.5, 0.5, 0}, {1, 0, 0}, {}}), UnsupportedError);
  const Particle good = particle_at(scene, {{0.5, 0.25, 0}, {1, 0, 0}, {}});
  Trajectory trajectory(AskFirstHit(), scene, {{0.5, 0.25, 0}, {1, 0, 0}, {}});
  CHECK_NOTHROW(trajectory.set_state(good));
  for (const auto& spoil : std::vector<void (*)(Particle&)>{
           [](Particle& one) { one.atom = 1; }, [](Particle& one) { one.lattice = -1; },
           [](Particle& one) { one.velocity = {}; }, [](Particle& one) { one.offset[0] = NAN; },
           [](Particle& one) { one.speed_squared = 0; }, [](Particle& one) { one.velocity[0] = NAN; },
           [](Particle& one) { one.velocity[1] = HUGE_VAL; }, [](Particle& one) { one.time_low = NAN; },
           [](Particle& one) { one.offset_low[1] = HUGE_VAL; },
           [](Particle& one) { one.velocity_low[0] = NAN; },
           [](Particle& one) { one.speed_squared_low = NAN; }}) {
    Particle bad = good;
    spoil(bad);
    CHECK_THROWS_AS(trajectory.set_state(bad), InputError);
  }
  CHECK_NOTHROW(particle_at(unit_scene(2, 1e-20), {{0.5, 0.5, 0}, {1, 0, 0}, {}}));
}

// ---- superposed lattices

namespace {

// Follows a particle for at most `collisions`, or until it escapes. Returns how many each lattice had.
std::vector<int> check_flights(const Scene& scene, const Query& start, int collisions) {
  const oracle::Oracle oracle(scene);
  const Reduction engine(scene);
  Trajectory trajectory(engine, scene, start);
  std::vector<int> seen(scene.lattices.size());
  for (int i = 0; i < collisions; ++i) {
    const Particle before = trajectory.state();
    Query query{trajectory.place(), before.velocity, {}};
    if (before.leaves) {
      query.from = ObstacleId{before.lattice, before.atom, {}};
      for (int k = 0; k < 3; ++k) query.from->cell[k] = before.cell[k];
    }
    const Answer answer = oracle.first_hit(query);
    const bool hit = trajectory.advance();
    const Particle& now = trajectory.state();
    REQUIRE((hit ? answer.outcome == Outcome::hit
                 : answer.outcome == Outcome::never && trajectory.stop() == Stop::never));
    if (!hit) break;
    CHECK(now.lattice == answer.obstacle.lattice);
    for (int k = 0; k < 3; ++k) CHECK(now.cell[k] == answer.obstacle.cell[k].int64());
    ++seen[now.lattice];
  }
  return seen;
}

}  // namespace

TEST_CASE("Superposed lattices: every flight is the oracle's", "[trajectory]") {
  Draw draw(23);
  const std::vector<int> seen = check_flights(two_lattices(), start_between(draw, 2), 200);
  CHECK(seen[0] > 50);
  CHECK(seen[1] > 20);
}

TEST_CASE("Among rows and layers every flight is the oracle's, until the particle escapes", "[trajectory]") {
  for (const int dimension : {2, 3})
    for (int rank = 0; rank < dimension; ++rank) {
      Draw draw(static_cast<std::uint64_t>(10 * dimension + rank));
      // Two lattices of that rank face each other, in other vectors.
      Scene scene = unit_scene(dimension, 0.45);
      scene.lattices.push_back(scene.lattices[0]);
      for (Lattice& lattice : scene.lattices) {
        lattice.rank = rank;
        for (int i = rank; i < dimension; ++i) lattice.vectors[i] = {};
      }
      if (rank > 0) scene.lattices[1].vectors[0][0] = 1.125;
      scene.lattices[1].atoms[0].position[dimension - 1] = 1.5;
      int collisions = 0, longest = 0;
      for (int i = 0; i < 200; ++i) {
        Query start{draw.vec(dimension, -3, 3), draw.vec(dimension, -1, 1), {}};
        start.x[dimension - 1] = 0.75;
        for (int k = rank; k < dimension - 1; ++k) start.x[k] *= 0.1, start.v[k] *= 0.1;
        start.x[0] += std::ldexp(1, 30) * (rank > 0);
        const std::vector<int> seen = check_flights(scene, start, 40);
        collisions += seen[0] + seen[1], longest = std::max(longest, seen[0] + seen[1]);
      }
      INFO(dimension << "D, rank " << rank << ": " << collisions << ", " << longest);
      CHECK(collisions > (rank == 0 ? 10 : 200));
      CHECK(longest >= (rank == 0 ? 2 : 3));
    }
}

TEST_CASE("A displacement is exact where both places are far away", "[trajectory]") {
  const Scene scene = ellipses(0.3);
  Particle from = particle_at(scene, {{0.5, 0.375, 0}, {1, 0, 0}, {}}), to = from;
  from.cell = {std::int64_t{1} << 62, -(std::int64_t{1} << 60) - 1, 0};
  to.cell = {(std::int64_t{1} << 62) + 3, -(std::int64_t{1} << 60), 0};
  to.offset[0] += 0x1p-20;
  CHECK(displacement(scene, from, to) == Vec{3 + 0x1p-20, 1, 0});
  CHECK(place_of(scene, to)[0] == 0x1p62);
}

TEST_CASE("A certified collision is where its obstacle's centre and the offset are", "[trajectory]") {
  Scene scene = ellipses(0.3);
  scene.lattices[0].atoms[0].position = {0.25, 0.5, 0};
  oracle::CertifiedCollision collision;
  collision.obstacle = {0, 0, {2, -1, 0}};
  collision.offset = {-0.125, 0.0625, 0}, collision.velocity = {8, 16, 0};
  CHECK(rival::place_of(scene, collision) == Vec{2.125, -0.4375, 0});
}

TEST_CASE("A way whose square is beyond the range leads nowhere", "[trajectory]") {
  const auto on_the_line = [](double way) {
    MeetingShape<double> shape;
    shape.radius = 1;
    return meeting_of(shape, Point<double>{-way, 0, 0}, Point<double>{1, 0, 0}, 0x1p-48 * way).on_the_line;
  };
  CHECK(on_the_line(1e150));
  CHECK_FALSE(on_the_line(1e160));
}
