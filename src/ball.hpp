// Line and ball in plain binary64, as the two known algorithms do it.
#pragma once

#include <cmath>
#include <optional>

#include "problem.hpp"

namespace lorentz {

inline double dot(const Vec& a, const Vec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The time at which the line x + t v enters the ball of radius r around the origin, from the textbook
/// quadratic t = -B - sqrt(B^2 - C), B = x.v / v^2, C = (x^2 - r^2) / v^2; may be negative; nothing if B^2 <
/// C.
inline std::optional<double> entry_time(const Vec& x, const Vec& v, double r) {
  const double v2 = dot(v, v);
  const double B = dot(x, v) / v2;
  const double C = (dot(x, x) - r * r) / v2;
  const double discriminant = B * B - C;
  if (discriminant < 0) return std::nullopt;
  return -B - std::sqrt(discriminant);
}

}  // namespace lorentz
