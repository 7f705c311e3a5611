// Elementary geometry in plain binary64: products, a line and a ball, coordinates in a cell or an ellipsoid.
// Each function is the textbook formula, rounded at every step; the caller must allow for its error. To get
// the same bits everywhere, compile without contraction (-ffp-contract=off).
//
// All functions are always inlined. Otherwise the linker would keep one copy of each, and the library would
// compute with the copy of a program that was compiled with -ffast-math.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <lorentz/scene.hpp>

namespace lorentz {

[[gnu::always_inline]] inline double dot(const Vec& a, const Vec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

[[gnu::always_inline]] inline Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

[[gnu::always_inline]] inline Vec sum(const Vec& a, const Vec& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

[[gnu::always_inline]] inline Vec scaled(const Vec& a, double factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}

/// a + f b
[[gnu::always_inline]] inline Vec plus(const Vec& a, double f, const Vec& b) {
  return {a[0] + f * b[0], a[1] + f * b[1], a[2] + f * b[2]};
}

/// The square root of a.a, which may overflow or underflow even if the length itself does not.
[[gnu::always_inline]] inline double length(const Vec& a) {
  return std::sqrt(dot(a, a));
}

[[gnu::always_inline]] inline double largest_component(const Vec& a) {
  return std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
}

/// The length of a vector of any size. (std::hypot of other libraries differs in the last bit.)
[[gnu::always_inline]] inline double length_of_any(const Vec& a) {
  const double largest = largest_component(a);
  if (!(largest > 0 && std::isfinite(largest))) return largest;
  return largest * length({a[0] / largest, a[1] / largest, a[2] / largest});
}

/// a times 2^exponent
[[gnu::always_inline]] inline Vec times_power_of_two(const Vec& a, int exponent) {
  return {std::scalbn(a[0], exponent), std::scalbn(a[1], exponent), std::scalbn(a[2], exponent)};
}

/// The mean of the vectors' exponents, the unit in which products of their lengths are the safest. No vector may be 0.
[[gnu::always_inline]] inline int mean_exponent(const std::array<Vec, 3>& vectors, int dimension) {
  int sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i)
    sum += std::ilogb(largest_component(vectors[i]));
  return sum / dimension;
}

/// The time at which the line x + t v enters the ball of radius r around the origin, from the textbook
/// quadratic t = -B - sqrt(B^2 - C) with B = x.v / v^2 and C = (x^2 - r^2) / v^2. It may be negative. Nothing
/// if B^2 < C.
[[gnu::always_inline]] inline std::optional<double> entry_time(const Vec& x, const Vec& v, double r) {
  const double v2 = dot(v, v);
  const double B = dot(x, v) / v2;
  const double C = (dot(x, x) - r * r) / v2;
  const double discriminant = B * B - C;
  if (discriminant < 0) return std::nullopt;
  return -B - std::sqrt(discriminant);
}

/// The dual vectors, dual_i . vector_k = delta_ik: the rows of the inverse of (vector_1 | ... | vector_d). In
/// 2D the third vector and the third dual vector are the third axis. For dependent vectors the result is not
/// finite, or meaningless because of rounding.
[[gnu::always_inline]] inline std::array<Vec, 3> dual_of(std::array<Vec, 3> vectors, int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  double largest = 0;
  for (std::size_t i = 0; i < d; ++i) largest = std::max(largest, largest_component(vectors[i]));
  const int exponent = largest > 0 && std::isfinite(largest) ? std::ilogb(largest) : 0;
  for (std::size_t i = 0; i < d; ++i) vectors[i] = times_power_of_two(vectors[i], -exponent);
  for (std::size_t i = d; i < 3; ++i) vectors[i] = Vec{0, 0, 1};
  std::array<Vec, 3> dual;
  for (std::size_t i = 0; i < 3; ++i) dual[i] = cross(vectors[(i + 1) % 3], vectors[(i + 2) % 3]);
  const double volume = dot(vectors[0], dual[0]);
  for (std::size_t i = 0; i < d; ++i)
    for (double& component : dual[i]) component = std::scalbn(component / volume, -exponent);
  for (std::size_t i = d; i < 3; ++i) dual[i] = Vec{0, 0, 1};
  return dual;
}

/// The columns of A for an obstacle { position + A y : |y| < 1 }. For a ball they are the axes times its
/// radius. In 2D the third column is zero.
[[gnu::always_inline]] inline std::array<Vec, 3> semiaxes_of(const Atom& atom, int dimension) {
  std::array<Vec, 3> columns{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i) {
    if (atom.is_ball())
      columns[i][i] = atom.radius;
    else
      columns[i] = atom.semiaxes[i];
  }
  return columns;
}

/// The coordinates of a: (dual_1 . a, dual_2 . a, dual_3 . a).
[[gnu::always_inline]] inline Vec coordinates(const std::array<Vec, 3>& dual, const Vec& a) {
  return {dot(dual[0], a), dot(dual[1], a), dot(dual[2], a)};
}

/// Sets the vectors after the first `rank` ones, perpendicular to these and to each other, of length 1 up to
/// rounding.
[[gnu::always_inline]] inline void complete_perpendicularly(std::array<Vec, 3>& vectors, int rank,
                                                            int dimension) {
  const auto r = static_cast<std::size_t>(rank), d = static_cast<std::size_t>(dimension);
  std::array<Vec, 3> units{};  // orthonormal: the first i span the same space as the first i vectors
  for (std::size_t i = 0; i < d; ++i) {
    const auto across = [&](Vec v) {
      for (std::size_t j = 0; j < i; ++j) v = plus(v, -dot(v, units[j]), units[j]);
      return v;
    };
    Vec best = i < r ? across(vectors[i]) : Vec{};
    for (std::size_t axis = 0; i >= r && axis < d; ++axis) {
      Vec unit{};
      unit[axis] = 1;
      if (length(across(unit)) > length(best)) best = across(unit);
    }
    units[i] = scaled(best, 1 / length(best));
    if (i >= r) vectors[i] = units[i];
  }
}

}  // namespace lorentz
