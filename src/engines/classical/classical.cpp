#include "src/engines/classical/classical.hpp"

#include <cmath>
#include <optional>

#include <lorentz/engine_base.hpp>
#include <lorentz/geometry.hpp>
#include "src/engines/classical/cell_walk.hpp"

namespace lorentz {
namespace {

ObstacleId obstacle_of(const CellIndex& n) {
  return {0, 0, {Integer(n[0]), Integer(n[1]), Integer(n[2])}};
}

}  // namespace

Answer Classical::flight_of(const Ray& ray, double max_time) const {
  const int d = scene().dimension;
  const double r = scene().lattices[0].atoms[0].radius;
  const Vec& v = ray.v;
  Vec x = ray.x;
  CellIndex n{};
  for (int i = 0; i < d; ++i) {
    if (!(std::fabs(x[i]) < kMaxStart))
      return Answer::unsupported_because("start too far from the origin for binary64");
    const double home = std::floor(x[i] + 0.5);
    n[i] = static_cast<std::int64_t>(home);
    x[i] -= home;
  }
  const std::optional<CellIndex> left = ray.from ? index_of(ray.from->cell) : std::nullopt;
  const auto is_from = [&] { return left && n == *left; };
  if (dot(x, x) < r * r && !is_from()) return Answer::inside(obstacle_of(n));

  double elapsed = 0;
  for (long cell = 0; cell < kMaxCells; ++cell) {
    if (!is_from()) {
      const auto time = entry_time(x, v, r);
      if (time && *time >= 0) return Answer::hit(obstacle_of(n), elapsed + *time);
    }
    int axis = -1;
    double to_wall = std::numeric_limits<double>::infinity();
    for (int i = 0; i < d; ++i) {
      if (v[i] == 0) continue;
      const double time = (std::copysign(0.5, v[i]) - x[i]) / v[i];
      if (time < to_wall) {
        to_wall = time;
        axis = i;
      }
    }
    for (int i = 0; i < d; ++i) x[i] += to_wall * v[i];
    x[axis] = -std::copysign(0.5, v[axis]);
    n[axis] += v[axis] > 0 ? 1 : -1;
    elapsed += to_wall;
    if (elapsed > max_time) return Answer::never();  // before max_time, that is
  }
  return Answer::undecided();
}

}  // namespace lorentz
