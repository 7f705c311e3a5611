#include "cases/hard_moves.hpp"

#include <cmath>

#include <lorentz/geometry.hpp>
#include "cases/ulps.hpp"

namespace lorentz::cases {

Vec near_integer_direction(Random& random, int dimension, NumberFormat precision) {
  Vec v{};
  while (v == Vec{})
    for (int i = 0; i < dimension; ++i) v[i] = std::floor(9 * random.uniform()) - 4;
  for (int i = 0; i < dimension; ++i)
    if (const auto ulps = random.bits() % 4; v[i] != 0)
      v[i] = moved(v[i], static_cast<std::int64_t>(ulps), precision);
  return v;
}

namespace {

// In coordinates y the obstacle is the unit ball. The normal n of the collision is at y ~ A^T n there. The
// line passes the centre at the part of y across it, and is moved along that part.
template <class OffEdge>
bool move_by(const OffEdge& off_edge, const Scene& scene, const oracle::Oracle& oracle, Query& query,
             NumberFormat precision) {
  query = rounded(query, precision);
  if (query.v == Vec{}) return false;
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
  const double distance = std::sqrt(dot(y, y)), place = 1 + off_edge();
  for (int i = 0; i < scene.dimension; ++i)
    for (int k = 0; k < 3; ++k) query.x[k] += axes[i][k] * y[i] / distance * (place - distance);
  query = rounded(query, precision);
  return std::isfinite(query.x[0] + query.x[1] + query.x[2]) && oracle.is_free(query.x);
}

}  // namespace

bool move_to_edge(Random& random, const Scene& scene, const oracle::Oracle& oracle, Query& query,
                  NumberFormat precision) {
  const auto off_edge = [&random, octaves = 40 - missing_bits(precision)] {
    return std::exp2(-10 - octaves * random.uniform()) * (random.bits() & 1 ? 1 : -1);
  };
  return move_by(off_edge, scene, oracle, query, precision);
}

bool move_to_edge(double off_edge, const Scene& scene, const oracle::Oracle& oracle, Query& query) {
  return move_by([off_edge] { return off_edge; }, scene, oracle, query, NumberFormat::binary64);
}

}  // namespace lorentz::cases
