#include "src/engines/golse.hpp"

#include <cmath>

#include <lorentz/engine_base.hpp>
#include <lorentz/geometry.hpp>

namespace lorentz {
namespace {

// A lattice vector in the first octant: (q, p, q alpha - p), its columns, its rows, and how far a line of
// slope alpha through one end passes above the other. All three obey the recursion of the convergents.
using Remainder = Vec;

struct Neighbours {
  Remainder near, far;
};

// `near` is the first convergent of alpha that passes within `width` (q_N, p_N), `far` the first vector that
// does so on the other side: q_(N-1) + k q_N, p_(N-1) + k p_N. The convergents begin with 1/0 and 0/1. If the
// remainder of `near` is 0, each flight from (0,0) ends there, and `far` is not a number.
// Requires a width of at most sqrt(1 + alpha^2), which is less than the sum of the first two remainders.
Neighbours neighbours_of(double alpha, double width) {
  Remainder before{0, 1, -1}, near{1, 0, alpha};
  while (std::fabs(near[2]) > width) {
    const Remainder next = plus(before, std::floor(-before[2] / near[2]), near);
    before = near;
    near = next;
  }
  return {near, plus(before, std::ceil((std::fabs(before[2]) - width) / std::fabs(near[2])), near)};
}

// The disc that a flight from the disc (0,0) hits, whose line passes at the height b above its centre.
// Requires |b| < width / 2.
Remainder first_of_three(double alpha, double b, double width) {
  const auto [near, far] = neighbours_of(alpha, width);
  if (std::fabs(b + near[2]) < width / 2) return near;
  if (std::fabs(b + far[2]) < width / 2) return far;
  return sum(near, far);
}

// When the line a + t v enters that disc: from the place closest to its centre back to its edge. `impact` is
// the line's distance from the centre, in units of the radius.
double time_of_entry(const Vec& a, const Vec& v, const Remainder& disc, double impact, double r) {
  const Vec way{disc[0] - a[0], disc[1] - a[1], 0};
  const double back = r * std::sqrt(std::max(0.0, (1 - impact) * (1 + impact)));
  return (dot(way, v) / length(v) - back) / length(v);
}

Answer unsupported(const char* why) {
  return Answer::unsupported_because(std::string("golse does ") + why);
}

}  // namespace

std::optional<std::string> Golse::beyond(const Scene& scene) {
  if (scene.dimension != 2 || !is_unit_scene(scene)) return "does the unit square lattice of discs only";
  if (scene.lattices[0].atoms[0].radius > 0.5) return "does radii up to half the spacing only";
  return std::nullopt;
}

void Golse::first_hit_scaled(const Ray& ray, double, Answer& answer) const {
  const double r = scene().lattices[0].atoms[0].radius;
  const int axes[2] = {std::fabs(ray.v[0]) < std::fabs(ray.v[1]), std::fabs(ray.v[0]) >= std::fabs(ray.v[1])};
  if (!ray.from) {
    answer = unsupported("flights that leave a disc only; the query has to name it as `from`");
    return;
  }
  // The start a, seen from the centre of that disc, and v, both reflected into the first octant.
  Vec a{}, v{};
  for (int i = 0; i < 2; ++i) {
    const Integer& n = ray.from->cell[axes[i]];
    const double x = ray.x[axes[i]], sign = std::copysign(1.0, ray.v[axes[i]]);
    if (!(n.fits_int64() && std::fabs(static_cast<double>(n.int64())) < kMaxStart &&
          std::fabs(x) < kMaxStart)) {
      answer = unsupported("starts and discs up to 2^51 cells from the origin only");
      return;
    }
    a[i] = sign * (x - static_cast<double>(n.int64()));
    v[i] = std::fabs(ray.v[axes[i]]);
  }
  const double alpha = v[1] / v[0], width = 2 * r * std::sqrt(1 + alpha * alpha), b = a[1] - alpha * a[0];
  if (!(std::fabs(b) < width / 2)) {
    answer = unsupported("flights along a line that meets the disc `from` only");
    return;
  }
  const Remainder disc = first_of_three(alpha, b, width);
  if (!(disc[0] < 0x1p52)) {
    answer = Answer::undecided();
    return;
  }
  const double time = time_of_entry(a, v, disc, (b + disc[2]) / (width / 2), r);
  if (dot(a, a) > r * r && (dot(a, v) < 0 || time < 0)) {
    answer = unsupported("starts on the disc `from`, or between it and the next one, only");
    return;
  }
  ObstacleId hit = *ray.from;
  for (int i = 0; i < 2; ++i)
    hit.cell[axes[i]] = hit.cell[axes[i]].int64() + std::llround(std::copysign(disc[i], ray.v[axes[i]]));
  answer = Answer::hit(hit, std::max(0.0, time));
}

}  // namespace lorentz
