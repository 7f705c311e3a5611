#include "hard_cases.hpp"

#include <cmath>
#include <limits>

namespace lorentz::cli {
namespace {

// A direction of integers from -4 to 4, each nonzero component moved by up to 3 ulps.
Vec near_rational_direction(Random& random, int dimension) {
  Vec v{};
  while (v == Vec{})
    for (int i = 0; i < dimension; ++i) v[i] = std::floor(9 * random.uniform()) - 4;
  for (int i = 0; i < dimension; ++i)
    for (auto ulps = random.bits() % 4; v[i] != 0 && ulps > 0; --ulps)
      v[i] = std::nextafter(v[i], std::numeric_limits<double>::infinity());
  return v;
}

// Moves the start across the line, so that the ball that is hit is passed at its edge. False: the start is
// then in a ball, or nothing was hit.
bool make_grazing(Random& random, const Scene& scene, const oracle::Oracle& oracle, Query& query) {
  oracle::Request request;
  request.detail = true;
  const Answer answer = oracle.first_hit(query, request);
  if (answer.outcome != Outcome::hit || !answer.detail) return false;
  const double r = scene.lattices[answer.obstacle.lattice].atoms[answer.obstacle.atom].radius;
  const Detail& detail = *answer.detail;
  const double speed = std::hypot(query.v[0], query.v[1], query.v[2]), b = detail.impact_parameter;
  double along = 0;
  for (int k = 0; k < 3; ++k) along += detail.normal[k] * query.v[k] / speed;
  const double off_edge = std::exp2(-10 - 40 * random.uniform()) * (random.bits() & 1 ? 1 : -1);
  for (int k = 0; k < 3; ++k) {  // the unit vector across, from the centre to the line
    const double across = (detail.normal[k] - along * query.v[k] / speed) * r / b;
    query.x[k] += across * (r * (1 + off_edge) - b);
  }
  return std::isfinite(query.x[0] + query.x[1] + query.x[2]) && oracle.is_free(query.x);
}

}  // namespace

const char* name_of(Difficulty difficulty) {
  switch (difficulty) {
    case Difficulty::drawn:
      return "drawn";
    case Difficulty::near_rational:
      return "near-rational";
    case Difficulty::grazing:
      return "grazing";
  }
  return "";
}

std::vector<Query> hard_queries(Difficulty difficulty, const Scene& scene, const oracle::Oracle& oracle,
                                std::uint64_t seed, std::size_t count) {
  std::vector<Query> queries = draw_queries(scene, oracle, seed, count);
  if (difficulty == Difficulty::drawn) return queries;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    Random random(seed ^ 0x6861'7264, i);
    if (difficulty == Difficulty::near_rational) {
      queries[i].v = near_rational_direction(random, scene.dimension);
      continue;
    }
    for (int tries = 0; tries < 100; ++tries) {
      Query moved = queries[i];
      if (!make_grazing(random, scene, oracle, moved)) continue;
      queries[i] = moved;
      break;
    }
  }
  return queries;
}

}  // namespace lorentz::cli
