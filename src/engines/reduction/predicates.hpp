// The formulas whose rounding errors decide, as templates on the number type: the engine runs them on
// binary64, tests/engines/bounds_test.cpp on numbers that carry their error. Bounds: bounds.hpp.
#pragma once

#include <cmath>

#include "src/engines/reduction/bounds.hpp"

namespace lorentz {

/// Yes, no, or not certain at this precision.
enum class Decision { yes, no, doubtful };

/// 2D: height over the line of the lattice point n R - m L from an anchor at height y, where R and L have the
/// heights D_R and -D_L.
template <class T>
T height_in_row(const T& y, const T& n, const T& D_R, const T& m, const T& D_L) {
  return (y + n * D_R) - m * D_L;
}

/// Its position along the line, likewise.
template <class T>
T sum_along(const T& s, const T& n, const T& S_R, const T& m, const T& S_L) {
  return (s + n * S_R) + m * S_L;
}

/// |v|^2.
template <class T>
T speed_squared(const T& a, const T& b, const T& c) {
  return (a * a + b * b) + c * c;
}

/// Is |value| < limit, where value errs by at most error and limit by limit_error, relatively?
inline Decision is_below(double value, double limit, double error, double limit_error = kRho * kRoundoff) {
  const double size = std::fabs(value), spread = error + limit_error * limit;
  if (size + spread < limit) return Decision::yes;
  if (size - spread > limit) return Decision::no;
  return Decision::doubtful;
}

/// Is value > 0, where it errs by at most error?
inline Decision is_positive(double value, double error) {
  return value > error ? Decision::yes : value < -error ? Decision::no : Decision::doubtful;
}

}  // namespace lorentz
