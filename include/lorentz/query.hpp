// The question: which obstacle is hit first from here in this direction? A velocity has any length, and times
// are in units in which x + t v is the particle's place.
#pragma once

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

/// What is wrong with a query in this scene, or nothing: finite numbers, v != 0, `from` names an atom that
/// exists.
std::optional<std::string> flaw_of(const Query& query, const Scene& scene);

/// The query, or the obstacle, if it has no flaw in this scene; else throws InputError.
const Query& checked(const Query& query, const Scene& scene);
const ObstacleId& checked(const ObstacleId& obstacle, const Scene& scene);

}  // namespace lorentz
