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

Expansion place_without_rounding(const Wide& N, double home) {
  Expansion d(N.hi);
  d.add(N.lo);
  d.add(home);
  return d;
}

// The value of the last bit that is set in a != 0.
double lowest_bit(double a) {
  constexpr int kBits = 52;
  const auto mantissa = std::bit_cast<std::uint64_t>(a) | std::uint64_t{1} << kBits;
  return std::ldexp(1, std::ilogb(a) - kBits + std::countr_zero(mantissa));
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

bool is_perpendicular(const double (&v)[3], const Vec& normal) {
  Expansion along =
      sum_of_products(Expansion(v[0]), Expansion(normal[0]), Expansion(v[1]), Expansion(normal[1]), 1);
  along.add_product(Expansion(v[2]), Expansion(normal[2]));
  return along.is_exact() && along.is_zero();
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

double unrounded_slack(int dimension, const double* v, const Wide* N, const double* home, double r) {
  const Expansion radius(r), square = sum_of_products(radius, radius, radius, Expansion(), 1);
  Expansion d[3], speed[3], speed2, slack;
  for (int k = 0; k < dimension; ++k) {
    d[k] = place_without_rounding(N[k], home[k]);
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

void unrounded_place(const double (&v)[3], const Wide (&N)[3], const Vec& home, double begin, Vec& place) {
  Expansion d[3], speed[3], forms[3];
  for (int k = 0; k < 3; ++k) d[k] = place_without_rounding(N[k], home[k]), speed[k] = Expansion(v[k]);
  forms[0] = sum_of_products(speed[0], d[1], speed[1], d[0], -1);
  const Expansion level = sum_of_products(speed[0], d[0], speed[1], d[1], 1),
                  square = sum_of_products(speed[0], speed[0], speed[1], speed[1], 1);
  forms[1] = sum_of_products(square, d[2], speed[2], level, -1);
  forms[2] = level;
  forms[2].add_product(speed[2], d[2]);
  forms[2].add(-begin);
  for (int k = 0; k < 3; ++k) place[k] = forms[k].is_exact() ? forms[k].value() : std::nan("");
}

bool stays_between_planes(const double (&v)[3], const Vec& home, double r) {
  Vec near, normal;
  return set_near_vector(v, near) && set_normal(near, v, normal) && is_beside(normal, home, r);
}

bool stays_between_planes(const double (&v)[3], const Vec& home, double r, const Vec& a, const Vec& b) {
  Vec normal;
  return set_normal(a, b, normal) && is_perpendicular(v, normal) && is_beside(normal, home, r);
}

}  // namespace lorentz
