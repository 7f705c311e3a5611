#include "hard_cases.hpp"

#include <cmath>
#include <limits>

#include "dual.hpp"

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

// Moves the start across the line, so that the obstacle that is hit is passed at its edge. False: the start
// is then in an obstacle, or nothing was hit. In coordinates y in which the obstacle is the unit ball: the
// normal n of the collision stands at y ~ A^T n, the line passes the centre at the part of y across it, and
// is moved along that.
bool make_grazing(Random& random, const Scene& scene, const oracle::Oracle& oracle, Query& query) {
  oracle::Request request;
  request.detail = true;
  const Answer answer = oracle.first_hit(query, request);
  if (answer.outcome != Outcome::hit || !answer.detail) return false;
  const auto axes =
      semiaxes_of(scene.lattices[answer.obstacle.lattice].atoms[answer.obstacle.atom], scene.dimension);
  Vec y = coordinates(axes, answer.detail->normal), w = coordinates(dual_of(axes, scene.dimension), query.v);
  if (scene.dimension == 2) y[2] = w[2] = 0;
  const double length = std::sqrt(dot(y, y)), along = dot(y, w) / length / dot(w, w);
  for (int i = 0; i < 3; ++i) y[i] = y[i] / length - along * w[i];
  const double distance = std::sqrt(dot(y, y));
  const double off_edge = std::exp2(-10 - 40 * random.uniform()) * (random.bits() & 1 ? 1 : -1);
  for (int i = 0; i < scene.dimension; ++i)
    for (int k = 0; k < 3; ++k) query.x[k] += axes[i][k] * y[i] / distance * (1 + off_edge - distance);
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
