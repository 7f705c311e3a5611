// The minimal work of any engine of this kind, and nothing else.
#pragma once

#include <algorithm>
#include <cmath>

#include <lorentz/vec.hpp>

namespace lorentz {

/// Computes the last convergent p/q of the slope of v before the denominator 1 / (2 r), in plain binary64.
/// Returns p + q.
inline double bare_continued_fraction(const Vec& v, double r) {
  const double a = std::fabs(v[0]), b = std::fabs(v[1]);
  double x = std::min(a, b) / std::max(a, b), term = std::floor(x), rest = x - term;
  double p_before = 1, p = term, q_before = 0, q = 1;
  while (q < 1 / (2 * r) && rest > 0) {
    x = 1 / rest, term = std::floor(x), rest = x - term;
    const double p_next = term * p + p_before, q_next = term * q + q_before;
    p_before = p, p = p_next, q_before = q, q = q_next;
  }
  return p + q;
}

}  // namespace lorentz
