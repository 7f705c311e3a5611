// Lyapunov exponents of a scene, by tangent vectors along many particles.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/scene.hpp>
#include "statistics/chaos/estimate.hpp"
#include "statistics/chaos/groups.hpp"

namespace lorentz::chaos {

struct LyapunovPlan {
  Scene scene;  ///< without flaws
  std::uint64_t seed = 0;
  std::uint64_t collisions = 1'000'000;  ///< that are counted, about: kGroups kParticles at least
  bool whole_spectrum = false;           ///< the negative ones, too
};

/// Particles of a group: each makes its share of the group's collisions.
inline constexpr std::uint64_t kParticles = 64;

/// Collisions of each particle before counting begins, in which tangent vectors find their directions.
inline constexpr std::uint64_t kUncounted = 64;

/// Exponents in nats, the largest first; errors are those of independent groups of particles.
struct Lyapunov {
  std::vector<Estimate> map;   ///< a collision
  std::vector<Estimate> flow;  ///< a unit of time, by the measured flights
  Estimate sum;                ///< of those
  Estimate growing;            ///< the sum of those above zero, the first d - 1
  Estimate mean_flight;  ///< as measured; with open corridors its error is too small (docs/free_paths.md)
  std::uint64_t collisions = 0;  ///< counted
  std::uint64_t stopped = 0;     ///< particles that ended (undecided, or in a corner); what they did counts
  bool is_whole = true;          ///< false: the work was stopped
};

/// Starts are drawn on the obstacles by the cosine law, the collision map's own measure, so that no collision
/// is lost to relaxation. The same numbers for any number of jobs. Throws InputError for a scene that the
/// fast engine does not do (Reduction::beyond), or in which nothing can start; and for a whole spectrum where
/// exponents are above some 18 (r below 2e-4 in 2D): there the negative ones are lost to rounding.
Lyapunov lyapunov_of(const LyapunovPlan& plan, const Work& work = {});

}  // namespace lorentz::chaos
