#include "statistics/chaos/lyapunov.hpp"

#include <algorithm>
#include <cmath>

#include <lorentz/errors.hpp>
#include <lorentz/trajectory_batch.hpp>
#include "question/starts/free_starts.hpp"
#include "statistics/chaos/tangents.hpp"
#include "statistics/chaos/theory.hpp"

namespace lorentz::chaos {
namespace {

// The values of a group: the growth of each tangent vector, and the total time of flight.
constexpr std::size_t kFlight = Tangents::kMost, kLyapunovValues = kFlight + 1;

Sums sums_of(const LyapunovPlan& plan, const Batch& engine, const starts::FreeStarts& starts,
             const Curvatures& curvatures, const Work& work, std::uint64_t group) {
  Particles particles(engine, plan.scene);
  for (std::uint64_t i = group * kParticles; i < (group + 1) * kParticles; ++i) particles.add(starts[i]);
  const int half = plan.scene.dimension - 1, count = plan.whole_spectrum ? 2 * half : half;
  std::vector<Tangents> tangents;
  for (std::size_t i = 0; i < particles.size(); ++i)
    tangents.emplace_back(particles[i].velocity, plan.scene.dimension, count);
  Sums sums{std::vector<double>(kLyapunovValues)};
  const auto visit = [&](std::size_t i, const Particle& particle, const Collision& collision) {
    std::array<double, Tangents::kMost> growth{};
    tangents[i].pass(particle, collision, curvatures, growth);
    if (particle.collisions <= kUncounted) return true;
    for (int k = 0; k < Tangents::kMost; ++k) sums.values[k] += growth[k];
    sums.values[kFlight] += collision.flight;
    ++sums.collisions;
    return true;
  };
  const std::uint64_t each = (plan.collisions + kGroups * kParticles - 1) / (kGroups * kParticles);
  for (std::uint64_t n = 0; n < kUncounted + each && !work.is_stopped(); ++n)
    particles.advance(HUGE_VAL, visit);
  sums.stopped = particles.size() - particles.going();
  return sums;
}

// Estimates of all exponents, of their sum, and of the sum of the first `half`.
Lyapunov told(const std::vector<Sums>& groups, int exponents, int half) {
  Lyapunov result;
  result.particles = groups.size() * kParticles;
  std::vector<double> part, sum(groups.size()), growing(groups.size()), flight;
  for (const Sums& group : groups) {
    flight.push_back(group.values[kFlight] / static_cast<double>(group.collisions));
    result.collisions += group.collisions, result.stopped += group.stopped;
  }
  for (int k = 0; k < exponents; ++k) {
    part.clear();
    for (std::size_t g = 0; g < groups.size(); ++g) {
      part.push_back(groups[g].values[k] / static_cast<double>(groups[g].collisions));
      sum[g] += part.back();
      if (k < half) growing[g] += part.back();
    }
    result.map.push_back(estimate_of(part));
    result.flow.push_back(estimate_of_ratio(part, flight));
  }
  result.sum = estimate_of(sum);
  result.growing = estimate_of(growing);
  result.mean_flight = estimate_of(flight);
  return result;
}

}  // namespace

Lyapunov lyapunov_of(const LyapunovPlan& plan, const Work& work) {
  if (const auto why = Reduction::beyond(plan.scene))
    throw InputError("trajectories of many particles are flown by the engine batch, which " + *why);
  const Batch engine(plan.scene);
  const starts::FreeStarts starts(plan.scene, starts::Kind::surface, plan.seed);
  const Curvatures curvatures(plan.scene);
  const auto all = for_each_group(
      work, [&](std::uint64_t group) { return sums_of(plan, engine, starts, curvatures, work, group); });
  std::vector<Sums> good;
  for (const auto& sums : all)
    if (sums && sums->collisions > 0) good.push_back(*sums);
  const int half = plan.scene.dimension - 1;
  Lyapunov result = told(good, plan.whole_spectrum ? 2 * half : half, half);
  if (result.collisions > 0 && !std::isfinite(result.sum.value))
    throw InputError(
        "the exponents below zero are lost to rounding: a collision parts neighbours by a factor of 10^8 or "
        "more, and what shrinks by as much is smaller than the last digit of what grows");
  result.is_whole = std::find(all.begin(), all.end(), std::nullopt) == all.end();
  result.plan = plan;
  result.exact = flights::mean_free_path_of(plan.scene);
  result.limit = half == 1 ? exponent_of_small_discs(plan.scene) : exponents_of_small_balls(plan.scene);
  return result;
}

}  // namespace lorentz::chaos
