#include <lorentz/query.hpp>

#include <string_view>

#include <lorentz/errors.hpp>
#include <lorentz/scene.hpp>

#include "src/problem/finite.hpp"
#include "src/problem/from_flaw.hpp"

namespace lorentz {

std::optional<std::string> flaw_of(const Query& query, const Scene& scene) {
  if (!all_finite(query.x)) return "x is not finite";
  if (!all_finite(query.v)) return "v is not finite";
  if (scene.dimension == 2 && (query.x[2] != 0 || query.v[2] != 0))
    return "x and v have two components in the plane: the third must be zero";
  if (query.v == Vec{}) return "v is zero: the particle needs a direction";
  return query.from ? from_flaw(*query.from, scene) : std::nullopt;
}

const Query& checked(const Query& query, const Scene& scene) {
  if (const auto flaw = flaw_of(query, scene)) throw InputError("query: " + *flaw);
  return query;
}

const ObstacleId& checked(const ObstacleId& obstacle, const Scene& scene) {
  if (const auto flaw = from_flaw(obstacle, scene))
    throw InputError("obstacle: " + flaw->substr(std::string_view("from ").size()));
  return obstacle;
}

}  // namespace lorentz
