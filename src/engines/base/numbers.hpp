// The operations in terms of which the shared code (files *-inl.hpp) is written, for one flight: a number is
// a double, a mask a bool. src/engines/batch/lanes-inl.hpp has them for the lanes of a vector.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "src/engines/base/fma.hpp"

namespace lorentz {

using std::sqrt;

inline double all(double a) {  ///< a constant, in every lane
  return a;
}
inline bool everywhere(bool m) {
  return m;
}
inline bool any(bool m) {
  return m;
}
inline bool nowhere(bool m) {
  return !m;
}
inline double select(bool m, double yes, double no) {
  return m ? yes : no;
}
inline double where(bool m, double a) {  ///< a, or zero
  return m ? a : 0;
}
inline void exchange(bool m, double& a, double& b) {
  if (m) std::swap(a, b);
}
/// The square root, or up to 1.07 times it, by halving the exponent. For bounds, where the time of a root is
/// not worth it.
inline double root_above(double a) {
  const auto bits = std::bit_cast<std::uint64_t>(a);
  return a < HUGE_VAL ? std::bit_cast<double>((bits >> 1) + (std::uint64_t{1023} << 51)) : a;
}
inline double IfThenZeroElse(bool m, double a) {
  return m ? 0 : a;
}
inline bool Not(bool m) {
  return !m;
}
inline bool And(bool a, bool b) {
  return a && b;
}
inline bool AndNot(bool not_a, bool b) {
  return !not_a && b;
}
inline bool Or(bool a, bool b) {
  return a || b;
}
inline double Neg(double a) {
  return -a;
}
inline double NegIf(bool m, double a) {  ///< without a branch
  return a * (1 - 2 * static_cast<double>(m));
}
inline double Abs(double a) {
  return std::fabs(a);
}
inline double Max(double a, double b) {
  return a < b ? b : a;
}
inline double Min(double a, double b) {
  return b < a ? b : a;
}
inline double CopySign(double size, double sign) {
  return std::copysign(size, sign);
}
inline double Floor(double a) {
  return std::floor(a);
}
inline double Ceil(double a) {
  return std::ceil(a);
}
inline double Round(double a) {  ///< to the nearest integer, ties to even
  return std::nearbyint(a);
}

}  // namespace lorentz
