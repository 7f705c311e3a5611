#include "src/engines/reduction/unrounded.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "src/engines/base/expansion.hpp"

namespace lorentz {
namespace {

// a b - c d.
Expansion difference(double a, const Expansion& b, double c, const Expansion& d) {
  Expansion sum;
  sum.add_product(Expansion(a), b);
  sum.add_product(Expansion(c), d, -1);
  return sum;
}

template <class B>
Expansion dot(const double (&a)[3], const B& b) {
  Expansion sum;
  for (int k = 0; k < 3; ++k) sum.add_product(Expansion(a[k]), Expansion(b[k]));
  return sum;
}

// The value of the last bit that is set in a normal number.
double lowest_bit(double a) {
  const auto bits = std::bit_cast<std::uint64_t>(a);
  return bits << 12 == 0 ? std::fabs(a) : std::fabs(a - std::bit_cast<double>(bits & (bits - 1)));
}

// Sets a short integer vector that is nearly parallel to v.
bool set_near_vector(const double (&v)[3], Vec& w) {
  const double largest = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
  for (double size = 1; size <= kShortVector; ++size) {
    double off = 0;
    for (int k = 0; k < 3; ++k) {
      const double component = v[k] * (size / largest);
      w[k] = std::nearbyint(component);
      off = std::max(off, std::fabs(component - w[k]));
    }
    if (off < kNearlyParallel) return true;
  }
  return false;
}

// The shortest integer vector along a x b; false if it is zero or not that short.
template <class B>
bool set_normal(const Vec& a, const B& b, Vec& normal) {
  constexpr double kLongest = 0x1p26;
  double bit = HUGE_VAL;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    Expansion component = difference(a[i], Expansion(b[j]), a[j], Expansion(b[i]));
    normal[k] = component.value();
    component.add(-normal[k]);
    if (!component.is_exact() || !component.is_zero()) return false;
    if (normal[k] != 0) bit = std::min(bit, lowest_bit(normal[k]));
  }
  std::int64_t divisor = 0;
  for (double& component : normal) {
    component /= bit;
    if (!(std::fabs(component) < kLongest)) return false;
    divisor = std::gcd(divisor, static_cast<std::int64_t>(component));
  }
  for (double& component : normal) component /= static_cast<double>(divisor);
  return divisor != 0;
}

// Is a line perpendicular to the normal farther than r from all planes?
bool is_beside(const Vec& normal, const Vec& home, double r) {
  Wide level(0);  // of the home cell's point over the line, in units of the planes' distance
  double size2 = 0;
  for (int k = 0; k < 3; ++k) {
    level = level + Wide::product(normal[k], home[k]);
    size2 += normal[k] * normal[k];
  }
  const double beside = std::fabs(level.hi - std::nearbyint(level.hi) + level.lo);
  return beside > r * std::sqrt(size2) * (1 + kAmple);
}

}  // namespace

// v = m bit + rest: the products of m with the cell are integers, and the others are small.
bool set_cross(const double (&v)[3], const Wide (&N)[3], const Vec& home, Wide (&cross)[3], Wide& along) {
  const double largest = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
  const double bit = std::ldexp(1, std::ilogb(largest) - 60);
  const auto rounded = [&](WideInteger n) -> Wide {
    const auto high = static_cast<double>(n);
    return {high * bit, static_cast<double>(n - static_cast<WideInteger>(high)) * bit};
  };
  WideInteger m[3], n[3];
  double rest[3];
  for (int k = 0; k < 3; ++k) {
    if (!(std::fabs(N[k].hi) < kMaxCell)) return false;
    n[k] = static_cast<std::int64_t>(N[k].hi) + static_cast<std::int64_t>(N[k].lo);
    m[k] = static_cast<std::int64_t>(v[k] / bit), rest[k] = v[k] - static_cast<double>(m[k]) * bit;
  }
  const auto small = [&](int i, int j) { return rest[i] * N[j] + Wide::product(v[i], home[j]); };
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    cross[k] = rounded(m[i] * n[j] - m[j] * n[i]) + (small(i, j) - small(j, i));
  }
  along = rounded(m[0] * n[0] + m[1] * n[1] + m[2] * n[2]) + (small(0, 0) + small(1, 1) + small(2, 2));
  return true;
}

void unrounded_place(const double (&v)[3], const Wide (&N)[3], const Vec& home, double begin, Vec& place) {
  Wide cross[3], along;
  if (!set_cross(v, N, home, cross, along)) return place.fill(std::nan(""));
  place = {cross[2].hi, (v[1] * cross[0] - v[0] * cross[1]).hi, (along - begin).hi};
}

double close_slack(const double (&v)[3], const Wide (&N)[3], const Vec& home, double r, double& error) {
  Wide cross[3], along, speed2 = 0, across2 = 0;
  if (!set_cross(v, N, home, cross, along)) return error = HUGE_VAL;
  double from_origin = kFromOrigin;
  for (int k = 0; k < 3; ++k) {
    speed2 = speed2 + Wide::product(v[k], v[k]), across2 = across2 + cross[k] * cross[k];
    from_origin += std::fabs(home[k]);
  }
  const Wide rho2 = Wide::product(r, r) * speed2;
  const double terms = rho2.hi + across2.hi + std::sqrt(across2.hi * speed2.hi) * from_origin;
  error = 4 * kCross * kRoundoff * kRoundoff * terms + kFlushedSlack;
  return (rho2 - across2).hi;
}

bool stays_between_planes(const double (&v)[3], const Vec& home, double r) {
  Vec near, normal;
  return set_near_vector(v, near) && set_normal(near, v, normal) && is_beside(normal, home, r);
}

bool stays_between_planes(const double (&v)[3], const Vec& home, double r, const Vec& a, const Vec& b) {
  Vec normal;
  if (!set_normal(a, b, normal)) return false;
  const Expansion along = dot(v, normal);
  return along.is_exact() && along.is_zero() && is_beside(normal, home, r);
}

}  // namespace lorentz
