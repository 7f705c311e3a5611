#include "statistics/chaos/diffusion.hpp"

#include <algorithm>
#include <array>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include <lorentz/trajectory_batch.hpp>
#include "question/starts/free_starts.hpp"
#include "statistics/chaos/theory.hpp"

namespace lorentz::chaos {
namespace {

constexpr std::uint64_t kParticlesTogether = 512;

// One particle's path up to now, and its values at the times of times_of().
struct Way {
  Vec first_velocity{}, displacement{}, integral{};  ///< integral: of the displacement over time
  double time = 0;
  int next = 0;  ///< index of the next time
  std::array<double, kTimes> square{}, from_velocity{};

  // Adds a flight with the velocity v until the time `until`.
  void fly(const Vec& v, double until, const std::vector<double>& times) {
    for (; next < kTimes && times[next] <= until; ++next) {
      const double s = times[next] - time;
      const Vec x = plus(displacement, s, v);
      square[next] = dot(x, x);
      from_velocity[next] = 2 * dot(first_velocity, integral_after(s, v));
    }
    const double s = until - time;
    integral = integral_after(s, v);
    displacement = plus(displacement, s, v);
    time = until;
  }

 private:
  Vec integral_after(double s, const Vec& v) const {
    return plus(plus(integral, s, displacement), s * s / 2, v);
  }
};

// The values of a group: the squares at all times, then their estimates from velocities.
constexpr int kFromVelocity = kTimes, kDiffusionValues = 2 * kTimes;

void add(const Way& way, Sums& sums) {
  for (int k = 0; k < kTimes; ++k) {
    sums.values[k] += way.square[k];
    sums.values[kFromVelocity + k] += way.from_velocity[k];
  }
  ++sums.particles;
}

// Flies the particles [first, last) to the time T. If the work is stopped earlier, the sums are unusable.
void fly_particles(const DiffusionPlan& plan, const Batch& engine, const starts::FreeStarts& starts,
                   std::uint64_t first, std::uint64_t last, const std::vector<double>& times,
                   const Work& work, Sums& sums) {
  Particles particles(engine, plan.scene);
  for (std::uint64_t i = first; i < last; ++i) particles.add(starts[i]);
  std::vector<Way> ways(particles.size());
  for (std::size_t i = 0; i < ways.size(); ++i) ways[i].first_velocity = particles[i].velocity;
  const auto visit = [&](std::size_t i, const Particle& particle, const Collision& collision) {
    ways[i].fly(collision.arriving, particle.time, times);
    return true;
  };
  while (!work.is_stopped() && particles.advance(plan.time, visit) > 0) continue;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    sums.collisions += particles[i].collisions;
    if (particles.stop(i) != Stop::time) {
      ++sums.stopped;
      continue;
    }
    ways[i].fly(particles[i].velocity, plan.time, times);
    add(ways[i], sums);
  }
}

// The slope of the least-squares line through the points.
double slope_of(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mx = 0, my = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) mx += x[i] / n, my += y[i] / n;
  for (std::size_t i = 0; i < x.size(); ++i) xx += (x[i] - mx) * (x[i] - mx), xy += (x[i] - mx) * (y[i] - my);
  return xy / xx;
}

// The diffusion coefficient from one group.
double coefficient_of(const Sums& sums, int dimension, const std::vector<double>& times) {
  const auto n = static_cast<double>(sums.particles);
  const int last = kTimes - 1;
  return (sums.values[last] - sums.values[last - 2]) / n / (dimension * times[last]);
}

double logarithmic_of(const Sums& sums, const std::vector<double>& times) {
  std::vector<double> logs, rates;
  for (int k = kTimes - 9; k < kTimes; ++k) {
    logs.push_back(std::log(times[k]));
    rates.push_back(sums.values[k] / static_cast<double>(sums.particles) / times[k]);
  }
  return slope_of(logs, rates);
}

template <class Of>
Estimate estimate_over(const std::vector<Sums>& groups, const Of& of) {
  std::vector<double> parts;
  for (const Sums& group : groups) parts.push_back(of(group));
  return estimate_of(parts);
}

Diffusion told_of_diffusion(const std::vector<Sums>& groups, int dimension,
                            const std::vector<double>& times) {
  Diffusion result;
  for (int k = 0; k < kTimes; ++k) {
    const auto mean = [](int which) {
      return [=](const Sums& sums) { return sums.values[which] / static_cast<double>(sums.particles); };
    };
    result.displacements.push_back(
        {times[k], estimate_over(groups, mean(k)), estimate_over(groups, mean(kFromVelocity + k))});
  }
  result.coefficient =
      estimate_over(groups, [&](const Sums& sums) { return coefficient_of(sums, dimension, times); });
  result.logarithmic = estimate_over(groups, [&](const Sums& sums) { return logarithmic_of(sums, times); });
  for (const Sums& group : groups) {
    result.particles += group.particles;
    result.collisions += group.collisions, result.stopped += group.stopped;
  }
  return result;
}

}  // namespace

std::vector<double> times_of(double longest) {
  std::vector<double> times;
  for (int k = kTimes - 1; k >= 0; --k)
    times.push_back(std::ldexp(k % 2 ? longest * 0x1.6a09e667f3bcdp-1 : longest, -(k / 2)));
  return times;
}

Diffusion diffusion_of(const DiffusionPlan& plan, const Work& work) {
  if (const auto why = Reduction::beyond(plan.scene))
    throw InputError("trajectories of many particles are flown by the engine batch, which " + *why);
  const Batch engine(plan.scene);
  const starts::FreeStarts starts(plan.scene, starts::kind_of(plan.from), plan.seed);
  const std::vector<double> times = times_of(plan.time);
  const auto all = for_each_group(work, [&](std::uint64_t group) {
    Sums sums{std::vector<double>(kDiffusionValues)};
    const std::uint64_t end = first_of(group + 1, plan.count);
    for (std::uint64_t i = first_of(group, plan.count); i < end && !work.is_stopped();
         i += kParticlesTogether)
      fly_particles(plan, engine, starts, i, std::min(i + kParticlesTogether, end), times, work, sums);
    return sums;
  });
  std::vector<Sums> good;
  for (const auto& sums : all)
    if (sums && sums->particles > 0) good.push_back(*sums);
  Diffusion result = told_of_diffusion(good, plan.scene.dimension, times);
  for (const auto& sums : all)
    if (sums && sums->particles == 0) result.stopped += sums->stopped;
  result.is_whole = std::find(all.begin(), all.end(), std::nullopt) == all.end();
  result.plan = plan;
  result.random_walk = machta_zwanzig(plan.scene);
  result.mean_free_path = flights::mean_free_path_of(plan.scene).value;
  result.tail = flights::tail_of_long_paths(plan.scene, flights::Ensemble::uniform);
  return result;
}

}  // namespace lorentz::chaos
