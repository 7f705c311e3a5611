// The query: which obstacle is hit first from a position in a direction? The velocity has any length, and
// times are in units in which x + t v is the particle's position.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include <lorentz/obstacle.hpp>
#include <lorentz/vec.hpp>

namespace lorentz {

struct Scene;

/// The ray x + t v, t >= 0, with v != 0. The obstacle `from`, if any, is ignored wherever x lies.
struct Query {
  Vec x{};
  Vec v{};
  std::optional<ObstacleId> from;
};

/// What is wrong with a query in this scene, or nothing if it is valid: the numbers are finite, v != 0,
/// `from` names an atom that exists, and the limit is not NaN.
std::optional<std::string> flaw_of(const Query& query, const Scene& scene,
                                   double max_time = std::numeric_limits<double>::infinity());

/// Returns the query or the obstacle if it is valid in this scene; otherwise throws InputError.
const Query& checked(const Query& query, const Scene& scene);
const ObstacleId& checked(const ObstacleId& obstacle, const Scene& scene);

}  // namespace lorentz
