// Lyapunov exponents of a scene, measured with tangent vectors along the trajectories of many particles.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/scene.hpp>
#include "statistics/chaos/groups.hpp"
#include "statistics/theory/laws.hpp"

namespace lorentz::chaos {

struct LyapunovPlan {
  Scene scene;  ///< without flaws
  std::uint64_t seed = 0;
  std::uint64_t collisions = 1'000'000;  ///< counted, about this many: at least kGroups kParticles
  bool whole_spectrum = false;           ///< compute the negative exponents, too
  std::string scene_name = {};           ///< as given by the user
};

/// Particles in a group; each makes an equal share of the group's collisions.
inline constexpr std::uint64_t kParticles = 64;

/// Collisions of each particle before counting begins. In them the tangent vectors find their directions.
inline constexpr std::uint64_t kUncounted = 64;

/// Exponents in nats, the largest first, with theory for comparison. Errors come from the scatter of independent
/// groups of particles.
struct Lyapunov {
  LyapunovPlan plan;
  std::vector<Estimate> map;   ///< per collision
  std::vector<Estimate> flow;  ///< per unit of time, from the measured flights
  Estimate sum;                ///< of the exponents in `map`
  Estimate growing;            ///< the sum of the positive exponents, the first d - 1
  Estimate mean_flight;  ///< as measured; with open corridors its error is too small (docs/free_paths.md)
  std::uint64_t particles = 0;   ///< in the groups that are counted
  std::uint64_t collisions = 0;  ///< counted
  std::uint64_t stopped = 0;     ///< particles that ended (undecided, or in a corner); their part counts
  bool is_whole = true;          ///< false: the work was stopped
  flights::MeanFreePath exact;
  std::optional<double> limit;  ///< as r -> 0: the first exponent (2D), the sum of the positive ones (3D)

  /// Exponent k per unit of time, from the exact mean free path where it is known.
  Estimate flow_of(std::size_t k) const;

  std::string table() const;
  std::string csv() const;   ///< one row per exponent
  std::string json() const;  ///< one object on one line
};

/// Starts are drawn on the obstacles by the cosine law, the invariant measure of the collision map, so that
/// no collision is lost to relaxation. The result does not depend on the number of jobs. Throws InputError
/// for a scene that the fast engine does not support (Reduction::beyond), or in which no particle can start.
/// Also throws for a whole spectrum if exponents are above about 18 (r below 2e-4 in 2D), because rounding
/// then destroys the negative ones.
Lyapunov lyapunov_of(const LyapunovPlan& plan, const Work& work = {});

}  // namespace lorentz::chaos
