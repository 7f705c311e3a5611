// Lyapunov exponents, held against values that other programs measured.
#include "statistics/chaos/lyapunov.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include <lorentz/reduction.hpp>
#include "statistics/chaos/tangents.hpp"
#include "statistics/chaos/theory.hpp"
#include "tests/support/support.hpp"
#include "tests/trajectory/coverage_support.hpp"

using namespace lorentz;
using namespace lorentz::chaos;
using namespace lorentz::test;

namespace {

// Within 4 standard errors of both.
void check(const Estimate& measured, double value, double error) {
  INFO(measured.value << " +- " << measured.error << ", should be " << value << " +- " << error);
  CHECK(std::fabs(measured.value - value) < 4 * std::hypot(measured.error, error));
  CHECK(measured.error < 0.03);
}

Lyapunov measured(const Scene& scene, std::uint64_t collisions, bool whole = false) {
  return lyapunov_of({scene, 9101, collisions, whole}, {.jobs = 2, .stop = nullptr, .on_progress = {}});
}

}  // namespace

TEST_CASE("The exponent of a square lattice is the one of another program", "[chaos]") {
  // By the recursion of a pencil's curvature, 10^7 collisions, a walk from column to column.
  check(measured(unit_scene(2, 0.4), 500'000).map[0], 1.70288, 0.00016);
  check(measured(unit_scene(2, 0.2), 500'000).map[0], 3.21347, 0.00025);
  check(measured(unit_scene(2, 0.01), 500'000).map[0], 9.09321, 0.00051);
}

TEST_CASE("Among the smallest obstacles exponent and mean flight are those of theory", "[chaos]") {
  for (const double radius : {1e-6, 1e-9, 1e-12}) {
    const Lyapunov result = measured(unit_scene(2, radius), 100'000);
    INFO(radius);
    CHECK(result.stopped == 0);
    check(result.map[0], *exponent_of_small_discs(unit_scene(2, radius)), 0);
    CHECK(std::fabs(result.mean_flight.value - 0.5 / radius) < 4 * result.mean_flight.error);
  }
  const Lyapunov balls = measured(unit_scene(3, 1e-6), 100'000);
  check(balls.growing, *exponents_of_small_balls(unit_scene(3, 1e-6)), 0.002);
}

TEST_CASE("The exponents of a cubic lattice are those of another program", "[chaos]") {
  // By two tangent vectors, 2 10^6 collisions.
  const Lyapunov result = measured(unit_scene(3, 0.2), 300'000);
  check(result.map[0], 4.1561, 0.0009);
  check(result.map[1], 3.7951, 0.0008);
  check(result.mean_flight, (1 - 4 * M_PI * 0.008 / 3) / (M_PI * 0.04), 0);
}

TEST_CASE("The exponents of a scene add up to nothing, and come in pairs", "[chaos]") {
  Scene ellipses = unit_scene(2, 1);
  ellipses.lattices[0].atoms = {{{0.01, 0, 0}, 0, {{0.27, 0.06, 0}, {-0.03, 0.15, 0}}},
                                {{0.47, 0.02, 0}, 0.03, {}}};
  Scene ellipsoids = unit_scene(3, 1);
  ellipsoids.lattices[0].atoms = {{{}, 0, {{0.3, 0, 0.05}, {0.02, 0.2, 0}, {0, 0.04, 0.25}}}};
  for (const Scene& scene : {unit_scene(2, 0.3), unit_scene(3, 0.3), ellipses, ellipsoids}) {
    const Lyapunov result = measured(scene, 50'000, true);
    const std::size_t n = result.map.size();
    REQUIRE(n == 2 * static_cast<std::size_t>(scene.dimension - 1));
    CHECK(std::fabs(result.sum.value) < 1e-9);
    for (std::size_t k = 0; k < n / 2; ++k) {
      CHECK(result.map[k].value > 0.5);
      CHECK(result.map[k].value + result.map[n - 1 - k].value == Approx(0).margin(0.01));
    }
  }
}

TEST_CASE("Tangent vectors are orthonormal and across the flight, from the start and after collisions",
          "[chaos]") {
  Draw draw(43);
  for (const int dimension : {2, 3}) {
    const Scene scene = unit_scene(dimension, 0.3);
    const Reduction engine(scene);
    const Curvatures curvatures(scene);
    const int count = 2 * (dimension - 1);
    for (int n = 0; n < 20; ++n) {
      const Vec v = scaled(draw.vec(dimension, -1, 1), std::exp2(draw.between(-3, 3)));
      Trajectory trajectory(engine, scene, {{0.5, 0.5, dimension == 3 ? 0.5 : 0}, v, {}});
      Tangents tangents(v, dimension, count);
      for (int step = 0; step < 3; ++step) {
        const Vec velocity = trajectory.state().velocity;
        for (int i = 0; i < count; ++i)
          for (int k = 0; k <= i; ++k) {
            Vec q, p, other_q, other_p;
            tangents.deviation(i, q, p), tangents.deviation(k, other_q, other_p);
            CHECK(dot(q, other_q) + dot(p, other_p) == Approx(i == k ? 1 : 0).margin(1e-7));
            CHECK(dot(q, velocity) == Approx(0).margin(1e-7 * length(v)));
            CHECK(dot(p, velocity) == Approx(0).margin(1e-7 * length(v)));
          }
        REQUIRE(trajectory.advance());
        std::array<double, Tangents::kMost> growth{};
        tangents.pass(trajectory.state(), trajectory.collision(), curvatures, growth);
      }
    }
  }
}

TEST_CASE("A tangent vector is the difference of two trajectories", "[chaos]") {
  // In double-double, 1e-20 apart: after six collisions the difference is that of the first order to 1e-8.
  Scene ellipsoids = unit_scene(3, 1);
  ellipsoids.lattices[0].atoms = {{{}, 0, {{0.3, 0, 0.05}, {0.02, 0.2, 0}, {0, 0.04, 0.25}}}};
  Scene ellipse = unit_scene(2, 1);
  ellipse.lattices[0].atoms = {{{}, 0, {{0.27, 0.06, 0}, {-0.03, 0.15, 0}}}};
  for (const Scene& scene : {unit_scene(2, 0.3), unit_scene(3, 0.3), ellipse, ellipsoids}) {
    const Reduction engine(scene);
    Draw draw(41);
    Query start{{0.5, 0.45, scene.dimension == 3 ? 0.55 : 0}, draw.vec(scene.dimension, -1, 1), {}};
    Trajectory one(engine, scene, start, Precision::double_double);
    Trajectory other(engine, scene, start, Precision::double_double);
    // The first tangent vector: dv = e across v, dq = unit e.
    Tangents tangents(start.v, scene.dimension, 1);
    const Curvatures curvatures(scene);
    Vec e = scene.dimension == 2
                ? Vec{-start.v[1], start.v[0], 0}
                : cross(start.v, std::fabs(start.v[0]) < std::fabs(start.v[1]) ? Vec{1, 0, 0} : Vec{0, 1, 0});
    e = scaled(e, 1 / length(e));
    Particle moved = other.state();
    constexpr double kApart = 1e-20;
    for (int k = 0; k < 3; ++k) {
      moved.offset_low[k] += kApart * curvatures.unit() * e[k];
      moved.velocity_low[k] += kApart * e[k];
    }
    other.set_state(moved);
    double logarithm = 0;
    for (int n = 0; n < 6; ++n) {
      REQUIRE(one.advance());
      REQUIRE(other.advance());
      std::array<double, Tangents::kMost> growth{};
      tangents.pass(one.state(), one.collision(), curvatures, growth);
      logarithm += growth[0];
    }
    // Lengths at the start: sqrt(2) in units of the offset's, so that growth counts from there.
    const auto difference = [](double a, double a_low, double b, double b_low) {
      return (a - b) + (a_low - b_low);
    };
    Vec dv{};
    for (int k = 0; k < 3; ++k)
      dv[k] = difference(other.state().velocity[k], other.state().velocity_low[k], one.state().velocity[k],
                         one.state().velocity_low[k]);
    Vec q = {}, p = {};
    tangents.deviation(0, q, p);
    const Vec expected = scaled(p, std::exp(logarithm) * std::sqrt(2) * kApart);
    INFO(expected[0] << ' ' << dv[0] << ", " << expected[1] << ' ' << dv[1]);
    CHECK(length(sum(dv, scaled(expected, -1))) < 1e-6 * length(dv));
  }
}

TEST_CASE("Exponents do not depend on the threads", "[chaos]") {
  const Scene scene = unit_scene(2, 0.3);
  const Lyapunov one = lyapunov_of({scene, 5, 20'000, true}, {.jobs = 1, .stop = nullptr, .on_progress = {}});
  const Lyapunov four =
      lyapunov_of({scene, 5, 20'000, true}, {.jobs = 4, .stop = nullptr, .on_progress = {}});
  REQUIRE(one.map.size() == four.map.size());
  for (std::size_t k = 0; k < one.map.size(); ++k) {
    CHECK(one.map[k].value == four.map[k].value);
    CHECK(one.map[k].error == four.map[k].error);
  }
  CHECK(one.mean_flight.value == four.mean_flight.value);
}

TEST_CASE("The sum above zero has the error of its groups, with the whole spectrum or without", "[chaos]") {
  const Scene scene = unit_scene(3, 0.3);
  const Lyapunov half = lyapunov_of({scene, 5, 20'000, false}), whole = lyapunov_of({scene, 5, 20'000, true});
  CHECK(whole.growing.value == Approx(half.sum.value).epsilon(1e-9));
  CHECK(whole.growing.error == Approx(half.sum.error).epsilon(1e-6));
  CHECK(half.growing.error == half.sum.error);
  // Errors of parts don't add up.
  CHECK(whole.growing.error < 0.99 * (whole.map[0].error + whole.map[1].error));
}

TEST_CASE("Errors of exponents, of their sum and of the mean flight hold the mean of other seeds",
          "[chaos][coverage][long]") {
  Scene overlapping = unit_scene(2, 0.35);
  overlapping.lattices[0].atoms.push_back({{0.5, 0.2, 0}, 0.3, {}});
  for (const Scene& scene : {unit_scene(2, 0.3), unit_scene(3, 0.3), overlapping}) {
    std::map<std::string, std::vector<Estimate>> found;
    for (std::uint64_t seed = 1; seed <= kCoverageSeeds; ++seed) {
      const Lyapunov one = lyapunov_of({scene, seed, 20'000, false});
      for (std::size_t k = 0; k < one.map.size(); ++k) {
        found[fmt::format("exponent {}", k)].push_back(one.map[k]);
        found[fmt::format("exponent {} a unit of time", k)].push_back(one.flow[k]);
      }
      found["sum"].push_back(one.growing);
      found["mean flight"].push_back(one.mean_flight);
    }
    for (const auto& [name, estimates] : found) check_coverage(name, estimates);
  }
}

TEST_CASE("The error of a ratio is that of what its parts depart from it", "[chaos]") {
  // Twice the same, part by part: no error, whatever theirs. Else both count.
  const Estimate same = estimate_of_ratio({2, 4, 6}, {1, 2, 3});
  CHECK(same.value == Approx(2));
  CHECK(same.error == Approx(0).margin(1e-12));
  const Estimate other = estimate_of_ratio({2, 4, 6}, {3, 2, 1});
  CHECK(other.value == Approx(2));  // departures -4, 0, 4 over 2
  CHECK(other.error == Approx(2 / std::sqrt(3.0)));
  const Scene overlapping = {2, {{{Vec{1, 0}, {0, 1}}, {{{}, 0.35, {}}, {{0.5, 0.2}, 0.3, {}}}}}};
  const Lyapunov result = measured(overlapping, 100'000);
  CHECK(result.flow[0].value == Approx(result.map[0].value / result.mean_flight.value));
  CHECK(result.flow[0].error > result.map[0].error / result.mean_flight.value);
}

TEST_CASE("Scenes without exponents are refused", "[chaos]") {
  CHECK_THROWS_AS(lyapunov_of({unit_scene(2, 6), 1, 1000, false}), InputError);
  CHECK_THROWS_AS(lyapunov_of({unit_scene(2, 1e-6), 1, 1000, true}), InputError);  // e^-27 of e^27
  CHECK(lyapunov_of({unit_scene(2, 1e-6), 1, 1000, false}).map[0].value == Approx(27.5).margin(0.1));
}

TEST_CASE("The closed forms of exponents and diffusion", "[chaos]") {
  CHECK(*exponent_of_small_discs(unit_scene(2, 0.001)) == Approx(13.815510558 - 0.1283720411).epsilon(1e-10));
  CHECK(*exponents_of_small_balls(unit_scene(3, 0.01)) == Approx(27.631021 - 1.9851).epsilon(1e-5));
  CHECK_FALSE(exponent_of_small_discs(unit_scene(3, 0.1)));
  CHECK_FALSE(machta_zwanzig(unit_scene(2, 0.4)));
  // The triangular lattice, in two bases.
  Scene scene = unit_scene(2, 0.45);
  scene.lattices[0].vectors[1] = {0.5, std::sqrt(0.75), 0};
  const double walk = machta_zwanzig(scene).value();
  scene.lattices[0].vectors[1] = {1.5, std::sqrt(0.75), 0};
  CHECK(machta_zwanzig(scene).value() == Approx(walk));
  // Twice the size in another unit.
  Scene large = unit_scene(2, 0.002);
  for (Vec& u : large.lattices[0].vectors) u = scaled(u, 2);
  CHECK(*exponent_of_small_discs(large) == Approx(*exponent_of_small_discs(unit_scene(2, 0.001))));
}
