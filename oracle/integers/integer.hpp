// The few integer operations that the oracle consists of. Private to oracle/ and fuzz/rewording.
#pragma once

#include <array>
#include <cmath>

#include <lorentz/obstacle.hpp>
#include "oracle/integers/z.hpp"

namespace lorentz::oracle {

template <std::size_t D>
using ZVec = std::array<Z, D>;

/// Largest integer <= a / b, for any b != 0.
inline Z floor_div(const Z& a, const Z& b) {
  return divide(a, b, Z::Rounding::down).quotient;
}

/// Smallest integer >= a / b, for any b != 0.
inline Z ceil_div(const Z& a, const Z& b) {
  return divide(a, b, Z::Rounding::up).quotient;
}

/// An integer nearest to a / b, for b > 0.
inline Z round_div(const Z& a, const Z& b) {
  if (bit_length(a) + 1 < bit_length(b)) return 0;
  return floor_div(2 * a + b, 2 * b);
}

/// A number to about 53 bits, for numbers up to 2^16384; infinite or NaN beyond.
using Estimate = long double;
inline Estimate estimate(const BinaryApproximation& a) {
  return std::ldexp(static_cast<Estimate>(a.mantissa), static_cast<int>(a.exponent));
}
inline Estimate estimate(const Z& a) {
  return estimate(approximation(a));
}

/// floor(sqrt(a)), for a >= 0.
inline Z floor_sqrt(const Z& a) {
  return square_root(a).floor;
}

/// Smallest integer whose square is >= a, for a >= 0.
inline Z ceil_sqrt(const Z& a) {
  Z::Root root = square_root(a);
  if (!root.exact) ++root.floor;
  return root.floor;
}

/// Largest integer whose square is < a, for a >= 1.
inline Z root_below(const Z& a) {
  return floor_sqrt(a - 1);
}

/// floor((a + sign * sqrt(d)) / q), for d >= 0 and q > 0; sign is +1 or -1. The result is exact, because
/// floor(y / q) = floor(floor(y) / q).
inline Z floor_surd(const Z& a, int sign, const Z& d, const Z& q) {
  return floor_div(sign > 0 ? a + floor_sqrt(d) : a - ceil_sqrt(d), q);
}

template <std::size_t D>
Z dot(const std::array<Z, D>& a, const std::array<Z, D>& b) {
  Z sum = a[0] * b[0];
  for (std::size_t i = 1; i < D; ++i) sum.add_product(a[i], b[i]);
  return sum;
}

/// a d - b c
inline Z minor_of(const Z& a, const Z& b, const Z& c, const Z& d) {
  Z result = a * d;
  result.subtract_product(b, c);
  return result;
}

inline Z cross(const ZVec<2>& a, const ZVec<2>& b) {
  return minor_of(a[0], a[1], b[0], b[1]);
}

inline ZVec<3> cross(const ZVec<3>& a, const ZVec<3>& b) {
  return {minor_of(a[1], a[2], b[1], b[2]), minor_of(a[2], a[0], b[2], b[0]),
          minor_of(a[0], a[1], b[0], b[1])};
}

inline Z to_z(const Integer& a) {
  return a.fits_int64() ? Z(a.int64()) : Z(a.decimal());
}

inline Integer to_integer(const Z& a) {
  if (a.fits_slong_p()) return Integer(a.get_si());
  return *Integer::from_decimal(a.get_str());
}

}  // namespace lorentz::oracle
