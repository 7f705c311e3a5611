// The two kinds of numbers in which states are kept, and vectors of them. Code for both kinds is written
// once. Private to src/trajectory.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include <lorentz/vec.hpp>
#include "src/engines/base/double_double.hpp"

namespace lorentz {

template <class Real>
using Point = std::array<Real, 3>;

template <class Real>
Real joined(double high, double low) {
  if constexpr (std::is_same_v<Real, Wide>)
    return Wide::sum(high, low);
  else
    return high;
}

inline double high_part(double x) {
  return x;
}
inline double low_part(double) {
  return 0;
}
inline double high_part(Wide x) {
  return x.hi;
}
inline double low_part(Wide x) {
  return x.lo;
}

/// An integer, exactly.
inline Wide wide(std::int64_t n) {
  const std::int64_t high = n >> 32;
  return Wide::sum(static_cast<double>(high) * 0x1p32, static_cast<double>(n - (high << 32)));
}

template <class Real>
Point<Real> joined(const Vec& high, const Vec& low = {}) {
  return {joined<Real>(high[0], low[0]), joined<Real>(high[1], low[1]), joined<Real>(high[2], low[2])};
}

template <class Real>
Vec high_part(const Point<Real>& a) {
  return {high_part(a[0]), high_part(a[1]), high_part(a[2])};
}
template <class Real>
Vec low_part(const Point<Real>& a) {
  return {low_part(a[0]), low_part(a[1]), low_part(a[2])};
}

inline Vec rounded(const Point<Wide>& a) {
  return {a[0].value(), a[1].value(), a[2].value()};
}

template <class Real>
Real inner(const Point<Real>& a, const Point<Real>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Real>
Point<Real> outer(const Point<Real>& a, const Point<Real>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// a + f b
template <class Real>
Point<Real> plus(const Point<Real>& a, Real f, const Point<Real>& b) {
  return {a[0] + f * b[0], a[1] + f * b[1], a[2] + f * b[2]};
}

template <class Real>
Point<Real> times(Real f, const Point<Real>& a) {
  return {f * a[0], f * a[1], f * a[2]};
}

}  // namespace lorentz
