#include "src/engines/reduction/unrounded.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "src/engines/base/expansion.hpp"

namespace lorentz {
namespace {

Expansion sum_of_products(const Expansion& a, const Expansion& b, const Expansion& c, const Expansion& d,
                          double sign) {
  Expansion sum;
  sum.add_product(a, b);
  sum.add_product(c, d, sign);
  return sum;
}

// The value of the last bit that is set in a != 0.
double lowest_bit(double a) {
  constexpr int kBits = 52;
  const auto mantissa = std::bit_cast<std::uint64_t>(a) | std::uint64_t{1} << kBits;
  return std::ldexp(1, std::ilogb(a) - kBits + std::countr_zero(mantissa));
}

// Sets a short integer vector that is nearly parallel to v.
bool set_near_vector(const double (&v)[3], double (&w)[3]) {
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
bool set_normal(const double (&a)[3], const double (&b)[3], double (&normal)[3]) {
  constexpr double kLongest = 0x1p26;
  double bit = HUGE_VAL;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    Expansion component =
        sum_of_products(Expansion(a[i]), Expansion(b[j]), Expansion(a[j]), Expansion(b[i]), -1);
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

}  // namespace

double unrounded_slack(int dimension, const double* v, const Wide* N, const double* home, double r) {
  const Expansion radius(r), square = sum_of_products(radius, radius, radius, Expansion(), 1);
  Expansion d[3], speed[3], speed2, slack;
  for (int k = 0; k < dimension; ++k) {
    d[k] = Expansion(N[k].hi);
    d[k].add(N[k].lo);
    d[k].add(home[k]);
    speed[k] = Expansion(v[k]);
    speed2.add_product(speed[k], speed[k]);
  }
  slack.add_product(square, speed2);
  for (int i = 0; i < dimension; ++i)
    for (int j = i + 1; j < dimension; ++j) {
      const Expansion across = sum_of_products(d[i], speed[j], d[j], speed[i], -1);
      slack.add_product(across, across, -1);
    }
  const double value = slack.value();
  return slack.is_exact() && std::fabs(value) > kFlushedSlack ? value : 0;
}

bool stays_between_planes(const double (&v)[3], const double (&home)[3], double r) {
  double near[3], normal[3];
  if (!set_near_vector(v, near) || !set_normal(near, v, normal)) return false;
  Wide level;  // of the home cell's point over the line, in units of the planes' distance
  double size2 = 0;
  level = Wide(0);
  for (int k = 0; k < 3; ++k) {
    level = level + Wide::product(normal[k], home[k]);
    size2 += normal[k] * normal[k];
  }
  const double beside = std::fabs(level.hi - std::nearbyint(level.hi) + level.lo);
  return beside > r * std::sqrt(size2) * (1 + kAmple);
}

}  // namespace lorentz
