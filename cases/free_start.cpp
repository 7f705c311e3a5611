#include "cases/free_start.hpp"

#include <optional>
#include <utility>

#include <lorentz/certified.hpp>
#include "cases/box.hpp"

namespace lorentz::cases {

const oracle::Oracle& oracle_of(const Scene& scene) {
  thread_local std::optional<std::pair<Scene, oracle::Oracle>> last;
  if (!last || last->first != scene) last.emplace(scene, oracle::Oracle(scene));
  return last->second;
}

Vec point_in_cell(Random& random, const Scene& scene) {
  return Box::cell_of(scene).point(random);
}

// Asks `certified`: for most points that takes a few comparisons in binary64.
bool starts_inside(const Scene& scene, const Query& query) {
  struct Latest {
    explicit Latest(const Scene& scene) : scene(scene), engine(scene) {}
    Scene scene;
    oracle::Certified engine;
  };
  thread_local std::optional<Latest> last;
  if (!last || last->scene != scene) last.emplace(scene);
  const Vec any = scene.dimension == 2 ? Vec{1, 0.625, 0} : Vec{1, 0.625, 0.4375};
  oracle::Request at_once;
  at_once.max_time = 0;
  return last->engine.first_hit({query.x, any, query.from}, at_once).outcome == Outcome::inside;
}

Vec free_point(Random& random, const Scene& scene) {
  constexpr int kTries = 20;
  for (int tries = 1;; ++tries) {
    const Vec x = point_in_cell(random, scene);
    if (tries == kTries || !starts_inside(scene, {x, {}, {}})) return x;
  }
}

Query free_flight(Random& random, const Scene& scene) {
  const Vec x = free_point(random, scene);
  return {x, random.direction(scene.dimension), {}};
}

}  // namespace lorentz::cases
