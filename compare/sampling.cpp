#include "compare/sampling.hpp"

#include <fmt/format.h>

#include <lorentz/exchange.hpp>
#include "cases/random.hpp"

namespace lorentz::compare {

using cases::Random;

std::vector<Query> draw_queries(const Scene& scene, const oracle::Oracle& oracle, std::uint64_t seed,
                                std::size_t count, const Listener& listener) {
  constexpr int kTries = 10'000;
  const bool superposition = scene.lattices.size() > 1;
  const Vec one_cell{1, 1, 1}, box = scene.dimension == 2 ? Vec{40, 25, 0} : Vec{10, 10, 10};
  const Vec& cells = superposition ? box : one_cell;
  std::vector<Query> queries;
  queries.reserve(count);
  for (std::size_t index = 0; index < count; ++index) {
    Random random(seed, "drawn queries", index);
    Query query;
    int tries = 0;
    do {
      if (++tries > kTries)
        throw InputError(fmt::format(
            "no free start in {} draws: the obstacles leave no free part of the cell, or nearly none",
            kTries));
      query.x = {};
      for (int i = 0; i < scene.dimension; ++i) {
        const double share = cells[i] * random.uniform();
        for (int k = 0; k < scene.dimension; ++k) query.x[k] += share * scene.lattices[0].vectors[i][k];
      }
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
