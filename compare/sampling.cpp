#include "compare/sampling.hpp"

#include <lorentz/errors.hpp>
#include "cases/box.hpp"
#include "flights/starts/starts.hpp"

namespace lorentz::compare {

using cases::Random;

std::vector<Query> draw_queries(const Scene& scene, const oracle::Oracle& oracle, std::uint64_t seed,
                                std::size_t count, const Listener& listener, std::size_t first) {
  constexpr std::uint64_t kTries = 10'000;
  const cases::Box box = cases::Box::of(scene);
  std::vector<Query> queries;
  queries.reserve(count);
  for (std::size_t index = first; index < first + count; ++index) {
    Random random(seed, "drawn queries", index);
    Query query;
    std::uint64_t tries = 0;
    do {
      if (++tries > kTries) throw InputError(flights::nowhere_to_start(kTries));
      query.x = box.point(random);
    } while (!oracle.is_free(query.x));
    query.v = random.direction(scene.dimension);
    queries.push_back(query);
    report(listener, "drawing", queries.size(), count);
  }
  return queries;
}

std::vector<Query> draw_leaving_queries(int dimension, double radius, std::uint64_t seed, std::size_t count) {
  std::vector<Query> queries;
  for (std::uint64_t index = 0; queries.size() < count; ++index) {
    Random random(seed, "leaving queries", index);
    const Vec normal = random.direction(dimension), v = random.direction(dimension);
    const double cosine = normal[0] * v[0] + normal[1] * v[1] + normal[2] * v[2];
    if (!(cosine > random.uniform())) continue;
    queries.push_back({{radius * normal[0], radius * normal[1], radius * normal[2]}, v, ObstacleId{}});
  }
  return queries;
}

}  // namespace lorentz::compare
