#include <lorentz/query.hpp>

#include <lorentz/scene.hpp>

#include "src/problem/finite.hpp"
#include "src/problem/from_flaw.hpp"

namespace lorentz {

std::optional<std::string> flaw_of(const Query& query, const Scene& scene) {
  if (!all_finite(query.x)) return "x is not finite";
  if (!all_finite(query.v)) return "v is not finite";
  if (query.v == Vec{}) return "v is zero: the particle needs a direction";
  return query.from ? from_flaw(*query.from, scene) : std::nullopt;
}

}  // namespace lorentz
