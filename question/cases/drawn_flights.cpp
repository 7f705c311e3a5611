#include "question/cases/drawn_flights.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include <lorentz/certified.hpp>
#include <lorentz/geometry.hpp>
#include "question/cases/box.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {

namespace {

// What `Made` is of the scene; each thread keeps the last one that it asked for.
template <class Made>
const Made& made_of(const Scene& scene) {
  thread_local std::optional<std::pair<Scene, Made>> last;
  if (!last || last->first != scene) last.emplace(scene, Made(scene));
  return last->second;
}

}  // namespace

const oracle::Oracle& oracle_of(const Scene& scene) {
  return made_of<oracle::Oracle>(scene);
}

Vec point_in_cell(Random& random, const Scene& scene) {
  return Box::cell_of(scene).point(random);
}

// Asks `certified`: for most points that takes a few comparisons in binary64.
bool starts_inside(const Scene& scene, const Query& query) {
  const Vec any = scene.dimension == 2 ? Vec{1, 0.625, 0} : Vec{1, 0.625, 0.4375};
  oracle::Request at_once;
  at_once.max_time = 0;
  const auto& engine = made_of<oracle::Certified>(scene);
  return engine.first_hit({query.x, any, query.from}, at_once).outcome == Outcome::inside;
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

Vec near_integer_direction(Random& random, int dimension, NumberFormat precision) {
  Vec v{};
  while (v == Vec{})
    for (int i = 0; i < dimension; ++i) v[i] = std::floor(9 * random.uniform()) - 4;
  for (int i = 0; i < dimension; ++i)
    if (const auto ulps = random.bits() % 4; v[i] != 0)
      v[i] = moved(v[i], static_cast<std::int64_t>(ulps), precision);
  return v;
}

// In coordinates y the obstacle is the unit ball. The normal n of the collision is at y ~ A^T n there. The
// line passes the centre at the part of y across it, and is moved along that part.
bool move_to_edge(const std::function<double()>& off_edge, const Scene& scene, const oracle::Oracle& oracle,
                  Query& query, NumberFormat precision) {
  query = rounded(query, precision);
  if (query.v == Vec{}) return false;
  const Answer answer = oracle.first_hit(query, {.detail = true});
  if (answer.outcome != Outcome::hit || !answer.detail) return false;
  const auto axes =
      semiaxes_of(scene.lattices[answer.obstacle.lattice].atoms[answer.obstacle.atom], scene.dimension);
  Vec y = coordinates(axes, answer.detail->normal), w = coordinates(dual_of(axes, scene.dimension), query.v);
  if (scene.dimension == 2) y[2] = w[2] = 0;
  for (Vec* one : {&y, &w}) {  // whatever the unit, and the same bits
    int exponent = 0;
    std::frexp(largest_component(*one), &exponent);
    *one = times_power_of_two(*one, -exponent);
  }
  const double length = std::sqrt(dot(y, y)), along = dot(y, w) / length / dot(w, w);
  for (int i = 0; i < 3; ++i) y[i] = y[i] / length - along * w[i];
  const double distance = std::sqrt(dot(y, y)), place = 1 + off_edge();
  for (int i = 0; i < scene.dimension; ++i)
    for (int k = 0; k < 3; ++k) query.x[k] += axes[i][k] * y[i] / distance * (place - distance);
  query = rounded(query, precision);
  return std::isfinite(query.x[0] + query.x[1] + query.x[2]) && oracle.is_free(query.x);
}

double drawn_off_edge(Random& random, NumberFormat precision) {
  const int octaves = 40 - missing_bits(precision);
  return std::exp2(-10 - octaves * random.uniform()) * (random.bits() & 1 ? 1 : -1);
}

}  // namespace lorentz::cases
