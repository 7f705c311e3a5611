// Mean squared displacements, and what they say of diffusion.
#include "statistics/chaos/diffusion.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include <lorentz/trajectory.hpp>
#include <lorentz/trajectory_batch.hpp>
#include "question/starts/candidates.hpp"
#include "statistics/chaos/groups.hpp"
#include "statistics/chaos/theory.hpp"
#include "statistics/theory/laws.hpp"
#include "tests/trajectory/coverage_support.hpp"

using namespace lorentz;
using namespace lorentz::chaos;

namespace {

// Discs of radius 1 with gaps of width w.
Scene triangular(double w) {
  Scene scene = unit_scene(2, 1);
  scene.lattices[0].vectors = {Vec{2 + w, 0, 0}, {(2 + w) / 2, (2 + w) * std::sqrt(0.75), 0}};
  return scene;
}

Diffusion measured(const Scene& scene, std::uint64_t count, double time, unsigned jobs = 2) {
  return diffusion_of({scene, flights::Ensemble::uniform, 9201, count, time},
                      {.jobs = jobs, .stop = nullptr, .on_progress = {}});
}

}  // namespace

TEST_CASE("Diffusion among discs of a triangular lattice is that of another program", "[chaos]") {
  // 4 10^5 trajectories, (MSD(80) - MSD(40)) / 160.
  const Diffusion wide = measured(triangular(0.3), 15'000, 40),
                  narrow = measured(triangular(0.1), 15'000, 40);
  INFO(wide.coefficient.value << " +- " << wide.coefficient.error << ", " << narrow.coefficient.value
                              << " +- " << narrow.coefficient.error);
  CHECK(std::fabs(wide.coefficient.value - 0.2484) < 4 * std::hypot(wide.coefficient.error, 0.0008));
  CHECK(std::fabs(narrow.coefficient.value - 0.0997) < 4 * std::hypot(narrow.coefficient.error, 0.0003));
  CHECK(wide.coefficient.error < 0.008);
  CHECK(*machta_zwanzig(triangular(0.3)) == Approx(0.175441).epsilon(1e-5));
  CHECK(*machta_zwanzig(triangular(0.1)) == Approx(0.103585).epsilon(1e-5));
  Scene stretched = triangular(0.1);  // the same angle's cosine times the first length, another length
  stretched.lattices[0].vectors[1][1] *= 2;
  CHECK_FALSE(machta_zwanzig(stretched));
}

TEST_CASE("Displacements from places and from velocities are the same", "[chaos]") {
  // <x(t)^2> = 2 <v(0) . integral of x from 0 to t>, of a gas in equilibrium, at every t.
  for (const Scene& scene : {triangular(0.3), unit_scene(2, 0.3), unit_scene(3, 0.4)}) {
    const Diffusion result = measured(scene, 40'000, 16);
    for (const Displacement& at : result.displacements) {
      INFO("t = " << at.time << ": " << at.square.value << ", " << at.from_velocity.value << " +- "
                  << at.from_velocity.error);
      CHECK(std::fabs(at.square.value - at.from_velocity.value) <
            4 * std::hypot(at.square.error, at.from_velocity.error));
      CHECK(at.square.value <= at.time * at.time * (1 + 1e-12));
    }
  }
}

TEST_CASE("In open corridors displacements grow faster than the time", "[chaos]") {
  // MSD / t grows by 2 C a unit of ln t, C / t being how the survival of free paths falls. Tails are heavy,
  // and long times needed: this sees that it grows, at about that rate; no more.
  const Scene scene = unit_scene(2, 0.4);
  const Diffusion result = measured(scene, 10'000, 400);
  double constant = 0;
  for (const flights::Tail& tail : flights::tails_of(scene, flights::Ensemble::uniform))
    if (tail.when == "t -> infinity") constant = tail.constant.value_or(0);
  INFO(result.logarithmic.value << " +- " << result.logarithmic.error << ", 2 C = " << 2 * constant);
  CHECK(constant == Approx(0.0512014).epsilon(1e-5));
  CHECK(std::fabs(result.logarithmic.value - 2 * constant) < 4 * result.logarithmic.error + 0.03);
  const Displacement& at_100 = result.displacements[kTimes - 5];
  CHECK(at_100.time == 100);
  INFO(at_100.square.value / 100 << " +- " << at_100.square.error / 100);
  CHECK(std::fabs(at_100.square.value / 100 - 1.323) < 4 * std::hypot(at_100.square.error / 100, 0.015));
}

TEST_CASE("The slope in ln t is that of the straight line nearest to MSD / t", "[chaos]") {
  // If groups are alike in size, the slope of the mean is the mean of the slopes.
  const Diffusion result = measured(unit_scene(2, 0.4), 640, 10);
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const Displacement& at : result.displacements) {
    if (at.time < 0.99 * 10 / 16) continue;
    const double log = std::log(at.time), rate = at.square.value / at.time;
    n += 1, x += log, y += rate, xx += log * log, xy += log * rate;
  }
  CHECK(n == 9);
  CHECK(result.logarithmic.value == Approx((n * xy - x * y) / (n * xx - x * x)).epsilon(1e-10));
}

TEST_CASE("Every particle of a group is flown once, of the second piece of it, too", "[chaos]") {
  const Scene scene = unit_scene(2, 0.3);
  constexpr std::uint64_t kCount = 600 * kGroups;  // of which 512 fly together
  constexpr double kTime = 2;
  const Diffusion all = measured(scene, kCount, kTime);
  const starts::Candidates starts(scene, flights::Ensemble::uniform, 9201);
  const Reduction engine(scene);
  std::uint64_t collisions = 0;
  double squares = 0;
  for (std::uint64_t index = 0; index < kCount; ++index) {
    Query start;
    std::uint64_t attempt = 0;
    do starts.draw(index, attempt++, start);
    while (std::hypot(start.x[0] - std::round(start.x[0]), start.x[1] - std::round(start.x[1])) < 0.3);
    Trajectory one(engine, scene, start);
    while (one.advance(kTime)) ++collisions;
    const Vec place = one.place();
    squares += std::pow(place[0] - start.x[0], 2) + std::pow(place[1] - start.x[1], 2);
  }
  CHECK(all.particles == kCount);
  CHECK(all.collisions == collisions);
  CHECK(all.displacements.back().square.value == Approx(squares / kCount).epsilon(1e-10));
}

TEST_CASE("Diffusion does not depend on the threads", "[chaos]") {
  const Diffusion one = measured(triangular(0.2), 2'000, 20, 1),
                  four = measured(triangular(0.2), 2'000, 20, 4);
  CHECK(one.coefficient.value == four.coefficient.value);
  CHECK(one.coefficient.error == four.coefficient.error);
  CHECK(one.collisions == four.collisions);
  CHECK(one.particles == 2'000);
}

namespace {

// The root mean square of deviations from their mean, in errors that were told.
double in_errors(const std::vector<Estimate>& estimates) {
  double mean = 0, squares = 0;
  const auto n = static_cast<double>(estimates.size());
  for (const Estimate& one : estimates) mean += one.value / n;
  for (const Estimate& one : estimates) squares += std::pow((one.value - mean) / one.error, 2) / (n - 1);
  return std::sqrt(squares);
}

}  // namespace

TEST_CASE("Errors of displacements are those of other seeds", "[chaos][coverage]") {
  constexpr std::uint64_t kSeeds = 100;
  std::vector<Estimate> coefficients, squares, from_velocities;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Diffusion one = diffusion_of({triangular(0.3), flights::Ensemble::uniform, seed, 640, 6},
                                       {.jobs = 2, .stop = nullptr, .on_progress = {}});
    coefficients.push_back(one.coefficient);
    squares.push_back(one.displacements[8].square);
    from_velocities.push_back(one.displacements.back().from_velocity);
  }
  // 1 +- 0.07 of a hundred.
  for (const auto& estimates : {coefficients, squares, from_velocities})
    CHECK(in_errors(estimates) == Approx(1).margin(0.3));
}

TEST_CASE("Errors of D, of its slope and of displacements at all times hold the mean of other seeds",
          "[chaos][coverage][long]") {
  for (const Scene& scene : {triangular(0.3), unit_scene(2, 0.4), unit_scene(3, 0.4)}) {
    std::map<std::string, std::vector<Estimate>> found;
    for (std::uint64_t seed = 1; seed <= test::kCoverageSeeds; ++seed) {
      const Diffusion one = diffusion_of({scene, flights::Ensemble::uniform, seed, 6'400, 8});
      found["D"].push_back(one.coefficient);
      found["slope in ln t"].push_back(one.logarithmic);
      for (const Displacement& at : one.displacements) {
        found[fmt::format("MSD({:.3g})", at.time)].push_back(at.square);
        found[fmt::format("MSD({:.3g}) from velocities", at.time)].push_back(at.from_velocity);
      }
    }
    for (const auto& [name, estimates] : found) test::check_coverage(name, estimates);
  }
}

TEST_CASE("The errors of one particle are infinite", "[chaos]") {
  const Diffusion one = measured(triangular(0.3), 1, 4);
  CHECK(one.particles == 1);
  CHECK(std::isinf(one.coefficient.error));
  CHECK(std::isinf(one.displacements[0].square.error));
  CHECK(std::isfinite(measured(triangular(0.3), 2, 4).coefficient.error));
}
