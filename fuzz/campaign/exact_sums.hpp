// Sums of integer multiples of binary64 values, if the sums are binary64 values again.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <lorentz/obstacle.hpp>
#include <lorentz/vec.hpp>
#include "oracle/integers/dyadic.hpp"

namespace lorentz::fuzz {

using oracle::Z;
using IntegerVec = std::array<Z, 3>;
using IntegerMatrix = std::array<IntegerVec, 3>;  ///< columns

inline constexpr int kDigits = 53, kLeastExponent = -1074, kLargestExponent = 1023;

/// mantissa 2^exponent, if that is a binary64 value.
inline std::optional<double> to_binary64(Z mantissa, long exponent) {
  if (mantissa == 0) return 0.0;
  const auto zeros = trailing_zeros(mantissa);
  const long bits = oracle::bit_length(mantissa);
  if (bits - zeros > kDigits || exponent + zeros < kLeastExponent || exponent + bits - 1 > kLargestExponent)
    return std::nullopt;
  return std::ldexp((mantissa >> zeros).get_d(), static_cast<int>(exponent + zeros));
}

/// a + n_1 u_1 + n_2 u_2 + n_3 u_3, if the components are binary64 values.
inline std::optional<Vec> exact_sum(const Vec& a, const IntegerVec& n, const std::array<Vec, 3>& u) {
  Vec result{};
  for (std::size_t i = 0; i < 3; ++i) {
    oracle::CommonExponent common;
    common.see(a[i]);
    for (std::size_t k = 0; k < 3; ++k)
      if (n[k] != 0) common.see(u[k][i]);
    Z sum = oracle::scaled(a[i], common.get());
    for (std::size_t k = 0; k < 3; ++k)
      if (n[k] != 0) sum += n[k] * oracle::scaled(u[k][i], common.get());
    const auto component = to_binary64(std::move(sum), common.get());
    if (!component) return std::nullopt;
    result[i] = *component;
  }
  return result;
}

/// a + n u, if the components are binary64 values.
inline std::optional<Vec> exact_sum(const Vec& a, const Z& n, const Vec& u) {
  return exact_sum(a, {n, 0, 0}, {u, Vec{}, Vec{}});
}

/// a times 2^exponent, if the components are binary64 values.
inline std::optional<Vec> exact_scaled(const Vec& a, int exponent) {
  Vec result{};
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = std::ldexp(a[i], exponent);
    if (!std::isfinite(result[i]) || std::ldexp(result[i], -exponent) != a[i]) return std::nullopt;
  }
  return result;
}

/// The lowest and the highest bit of numbers.
struct BitRange {
  long lowest = std::numeric_limits<long>::max(), highest = std::numeric_limits<long>::min();

  void see(double value) {
    if (value == 0) return;
    lowest = std::min(lowest, oracle::Dyadic(value).exponent);
    highest = std::max<long>(highest, std::ilogb(value));
  }
  void see(const Vec& a) {
    for (const double component : a) see(component);
  }
};

inline IntegerVec to_integers(const Cell& cell) {
  return {oracle::to_z(cell[0]), oracle::to_z(cell[1]), oracle::to_z(cell[2])};
}
inline Cell to_cell(const IntegerVec& n) {
  return {oracle::to_integer(n[0]), oracle::to_integer(n[1]), oracle::to_integer(n[2])};
}

inline IntegerVec operator*(const IntegerMatrix& m, const IntegerVec& n) {
  IntegerVec result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = m[0][i] * n[0] + m[1][i] * n[1] + m[2][i] * n[2];
  return result;
}

inline IntegerMatrix identity() {
  return {IntegerVec{1, 0, 0}, IntegerVec{0, 1, 0}, IntegerVec{0, 0, 1}};
}

/// The matrix A with A m = det(m) I.
inline IntegerMatrix adjugate(const IntegerMatrix& m) {
  const IntegerVec row[3] = {oracle::cross(m[1], m[2]), oracle::cross(m[2], m[0]), oracle::cross(m[0], m[1])};
  IntegerMatrix result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) result[k][i] = row[i][k];
  return result;
}

inline Z determinant(const IntegerMatrix& m) {
  return oracle::dot(m[0], oracle::cross(m[1], m[2]));
}

/// Vectors as integer multiples of 2^exponent; in 2D the third is (0, 0, 1) in this unit.
inline IntegerMatrix to_integers(const std::array<Vec, 3>& vectors, int dimension, long exponent) {
  IntegerMatrix m = identity();
  for (int k = 0; k < dimension; ++k)
    for (int i = 0; i < dimension; ++i) m[k][i] = oracle::scaled(vectors[k][i], exponent);
  return m;
}

}  // namespace lorentz::fuzz
