#include "src/engines/reduction/unrounded.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "src/engines/base/expansion.hpp"

namespace lorentz {
namespace {

// Sets a b - c d; false if it is not a binary64. (Nearly always the products differ by few of their bits.)
bool set_difference(double a, double b, double c, double d, double& difference) {
  const Wide p = Wide::product(a, b), q = Wide::product(c, d);
  const Wide high = Wide::sum(p.hi, -q.hi), low = Wide::sum(p.lo, -q.lo), whole = Wide::sum(high.hi, low.hi);
  const bool exact = std::fabs(p.hi) > 0x1p-960 && std::fabs(q.hi) > 0x1p-960;
  difference = whole.hi;
  if (exact && high.lo == 0 && low.lo == 0) return whole.lo == 0;
  Expansion sum;
  sum.add_product(Expansion(a), Expansion(b));
  sum.add_product(Expansion(c), Expansion(d), -1);
  difference = sum.value();
  sum.add(-difference);
  return sum.is_exact() && sum.is_zero();
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

double largest_of(double a, double b, double c) {
  return std::max({std::fabs(a), std::fabs(b), std::fabs(c)});
}

// The exponent of a normal number.
int exponent_of(double a) {
  return static_cast<int>(std::bit_cast<std::uint64_t>(std::fabs(a)) >> 52) - 1023;
}

// The nearest integer to a number below 2^51.
double nearest_integer(double a) {
  constexpr double kMagic = 0x1.8p52;
  return (a + kMagic) - kMagic;
}

// Sets a short integer vector that is nearly parallel to v.
bool set_near_vector(const double (&v)[3], Vec& w) {
  const double largest = largest_of(v[0], v[1], v[2]);
  for (double size = 1; size <= kShortVector; ++size) {
    double off = 0;
    for (int k = 0; k < 3; ++k) {
      const double component = v[k] * (size / largest);
      w[k] = nearest_integer(component);
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
    if (!set_difference(a[i], b[j], a[j], b[i], normal[k])) return false;
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

// v = m bit + rest: the products of m with the cell are integers, and the others are small. Beyond 2^61 cells the
// products of integers leave 128 bits, but their differences do not where d is nearly parallel to v.
bool set_cross(const double (&v)[3], const Wide (&N)[3], const Vec& home, Wide (&cross)[3], Wide* along) {
  const double farthest = largest_of(N[0].hi, N[1].hi, N[2].hi);
  if (!(farthest < kMaxWideCell)) return false;
  const int beyond = farthest < kMaxCell ? 0 : exponent_of(farthest) - 60;
  const int last = exponent_of(largest_of(v[0], v[1], v[2])) - 60 - beyond;
  const double bit = power_of_two(last), inverse = power_of_two(-last);
  const auto rounded = [&](WideInteger n) -> Wide {
    const auto high = static_cast<double>(n);
    return {high * bit, static_cast<double>(n - static_cast<WideInteger>(high)) * bit};
  };
  const auto integer_of = [beyond](double a) {
    return beyond == 0 ? WideInteger{static_cast<std::int64_t>(a)} : static_cast<WideInteger>(a);
  };
  __extension__ using Modular = unsigned __int128;
  Modular m[3], n[3];
  double rest[3];
  for (int k = 0; k < 3; ++k) {
    n[k] = static_cast<Modular>(integer_of(N[k].hi) + integer_of(N[k].lo));
    const WideInteger whole = integer_of(v[k] * inverse);
    m[k] = static_cast<Modular>(whole), rest[k] = v[k] - static_cast<double>(whole) * bit;
  }
  const auto small = [&](int i, int j) { return rest[i] * N[j] + Wide::product(v[i], home[j]); };
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    if (beyond > 0 && !(std::fabs(v[i] * N[j].hi - v[j] * N[i].hi) < 0x1p120 * bit)) return false;
    cross[k] = rounded(static_cast<WideInteger>(m[i] * n[j] - m[j] * n[i])) + (small(i, j) - small(j, i));
  }
  if (!along) return true;
  if (beyond == 0) {
    *along = rounded(static_cast<WideInteger>(m[0] * n[0] + m[1] * n[1] + m[2] * n[2])) +
             (small(0, 0) + small(1, 1) + small(2, 2));
  } else {
    const Wide home_part =
        (Wide::product(v[0], home[0]) + Wide::product(v[1], home[1])) + Wide::product(v[2], home[2]);
    *along = (v[0] * N[0] + v[1] * N[1]) + (v[2] * N[2] + home_part);
  }
  return true;
}

void unrounded_place(const double (&v)[3], const Wide (&N)[3], const Vec& home, double begin, Vec& place) {
  Wide cross[3], along;
  if (!set_cross(v, N, home, cross, &along)) return place.fill(std::nan(""));
  place = {cross[2].hi, (v[1] * cross[0] - v[0] * cross[1]).hi, (along - begin).hi};
}

double close_slack(const double (&v)[3], const Wide (&N)[3], const Vec& home, double r, double& error) {
  Wide cross[3], speed2 = 0, across2 = 0;
  if (!set_cross(v, N, home, cross, nullptr)) return error = HUGE_VAL;
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
