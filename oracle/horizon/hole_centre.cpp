#include "oracle/horizon/hole_centre.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lorentz::oracle {
namespace {

double quotient(const Z& a, const Z& b) {
  signed long exponent_a = 0, exponent_b = 0;
  const double x = mpz_get_d_2exp(&exponent_a, a.get_mpz_t()), y = mpz_get_d_2exp(&exponent_b, b.get_mpz_t());
  return std::ldexp(x / y, static_cast<int>(exponent_a - exponent_b));
}

// Orthogonal axes of the plane.
struct Frame {
  std::array<ZVec<3>, 2> axes;
  std::array<Z, 2> fine_units;  ///< |axis| times the largest disc's radius, times 2^kFineBits

  explicit Frame(const Shadow& shadow) {
    axes = {shadow.basis[0].p, cross(shadow.along, shadow.basis[0].p)};
    const Z r = shadow.discs[0].radius;
    for (int i : {0, 1})
      fine_units[i] = floor_sqrt(shifted_left(dot(axes[i], axes[i]) * r * r * shadow.along2, 2 * kFineBits));
  }
  /// Of a vector times 2^kFineBits.
  std::array<double, 2> coordinates(const ZVec<3>& fine) const {
    return {quotient(dot(fine, axes[0]), fine_units[0]), quotient(dot(fine, axes[1]), fine_units[1])};
  }
  std::array<double, 3> direction(int i) const {
    const Z length = floor_sqrt(shifted_left(dot(axes[i], axes[i]), 2 * kFineBits));
    std::array<double, 3> result;
    for (int k = 0; k < 3; ++k) result[k] = quotient(shifted_left(axes[i][k], kFineBits), length);
    return result;
  }
};

struct FlatDisc {
  double x, y, radius;
};

// The clearance at a point if it is above `floor`, else something not above it.
double clearance(const std::vector<FlatDisc>& discs, double x, double y, double floor) {
  double least = std::numeric_limits<double>::infinity();
  for (const FlatDisc& disc : discs) {
    const double dx = x - disc.x, dy = y - disc.y;
    least = std::min(least, std::sqrt(dx * dx + dy * dy) - disc.radius);
    if (least <= floor) break;
  }
  return least;
}

struct FlatPoint {
  double x, y, clearance;
};

// From the start in ever smaller steps, as long as the clearance grows. A start on the boundary may be in a
// sharp corner: the way out of that takes more looking for.
FlatPoint climb(std::vector<FlatDisc>& discs, double start_x, double start_y, double limit) {
  const auto distance = [&](const FlatDisc& disc) {
    return std::hypot(disc.x - start_x, disc.y - start_y) - disc.radius;
  };
  std::sort(discs.begin(), discs.end(),
            [&](const FlatDisc& a, const FlatDisc& b) { return distance(a) < distance(b); });
  double x = start_x, y = start_y, best = 0;
  for (double step = limit / 8; step > limit * (best > 0 ? 1e-8 : 1e-14);) {
    const int ways = best > 0 ? 12 : 96;
    bool better = false;
    for (int i = 0; i < ways && !better; ++i) {
      const double angle = 2 * M_PI * i / ways;
      const double to_x = x + step * std::cos(angle), to_y = y + step * std::sin(angle);
      const double there = clearance(discs, to_x, to_y, best);
      if (there <= best || std::hypot(to_x - start_x, to_y - start_y) > limit) continue;
      best = there;
      x = to_x;
      y = to_y;
      better = true;
    }
    if (!better) step /= 2;
  }
  return {x, y, best};
}

FlatPoint centre_in_plane(const Shadow& shadow, const HolePoint& hole, const Frame& frame) {
  const auto start = frame.coordinates(hole.offset);
  // Of one disc and its translates the point is the one furthest from all centres already.
  if (shadow.discs.size() == 1) return {start[0], start[1], std::hypot(start[0], start[1]) - 1};
  // No point is further from all centres than half |b1| + |b2|: within twice that is all that matters.
  const Z r = shadow.discs[0].radius, b11 = dot(shadow.basis[0].p, shadow.basis[0].p),
          b22 = dot(shadow.basis[1].p, shadow.basis[1].p);
  const Z reach = 2 * ceil_sqrt(ceil_div(2 * (b11 + b22), shadow.along2)) + 2 * r;
  ZVec<3> whole, point;
  for (std::size_t k = 0; k < 3; ++k) {
    mpz_fdiv_q_2exp(whole[k].get_mpz_t(), hole.offset[k].get_mpz_t(), kFineBits);
    point[k] = shadow.discs[hole.disc].centre[k] + whole[k];
  }
  std::vector<FlatDisc> discs;
  for (const Disc& disc : shadow.discs_around(point, reach, false)) {
    ZVec<3> fine;
    for (std::size_t k = 0; k < 3; ++k) fine[k] = shifted_left(disc.centre[k] + whole[k], kFineBits);
    const auto [x, y] = frame.coordinates(fine);
    discs.push_back({x, y, quotient(disc.radius, r)});
  }
  return climb(discs, start[0], start[1], quotient(reach, r) / 2);
}

}  // namespace

HoleCentre centre_of(const Shadow& shadow, const HolePoint& hole) {
  const Frame frame(shadow);
  const FlatPoint point = centre_in_plane(shadow, hole, frame);
  // Back from X = x cross g: the projection is (g cross X) / g^2.
  const auto first = frame.direction(0), second = frame.direction(1);
  HoleCentre result;
  for (int k = 0; k < 3; ++k) result.offset[k] = point.x * second[k] - point.y * first[k];
  result.clearance = point.clearance;
  return result;
}

}  // namespace lorentz::oracle
