// Numbers of twice the precision of a binary64: unevaluated sums hi + lo with |lo| <= ulp(hi)/2.
//
// The algorithms and their bounds are those of Joldes, Muller, Popescu, "Tight and rigorous error bounds for
// basic building blocks of double-word arithmetic", ACM TOMS 44 (2017), and, for the square root, of Lefevre,
// Louvet, Muller, Picot, Rideau, ACM TOMS 49 (2023). docs/bounds.md restates them; u = 2^-53.
#pragma once

#include "src/engines/base/fma.hpp"

namespace lorentz {

template <class Arch>
struct DoubleDouble {
  double hi, lo;  // like a double, not set unless said so

  DoubleDouble() = default;
  DoubleDouble(double value) : hi(value), lo(0) {}
  DoubleDouble(double high, double low) : hi(high), lo(low) {}
  template <class Other>
  explicit DoubleDouble(DoubleDouble<Other> same) : hi(same.hi), lo(same.lo) {}

  /// a + b, exact.
  static DoubleDouble sum(double a, double b) {
    const double s = a + b, b_part = s - a;
    return {s, (a - (s - b_part)) + (b - b_part)};
  }

  /// a + b, exact if |a| >= |b| or a = 0.
  static DoubleDouble ordered_sum(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
  }

  /// a * b, exact within the range that fma.hpp states.
  static DoubleDouble product(double a, double b) {
    const double p = a * b;
    return {p, Arch::product_error(a, b, p)};
  }

  DoubleDouble operator-() const { return {-hi, -lo}; }

  /// Relative error at most 3 u^2 + 13 u^3.
  friend DoubleDouble operator+(DoubleDouble x, DoubleDouble y) {
    const DoubleDouble s = sum(x.hi, y.hi), t = sum(x.lo, y.lo);
    const DoubleDouble v = ordered_sum(s.hi, s.lo + t.hi);
    return ordered_sum(v.hi, t.lo + v.lo);
  }
  friend DoubleDouble operator-(DoubleDouble x, DoubleDouble y) { return x + -y; }

  /// Relative error at most 5 u^2.
  friend DoubleDouble operator*(DoubleDouble x, DoubleDouble y) {
    const DoubleDouble p = product(x.hi, y.hi);
    return ordered_sum(p.hi, p.lo + (x.hi * y.lo + x.lo * y.hi));
  }

  /// Relative error at most 3 u^2.
  friend DoubleDouble operator*(DoubleDouble x, double y) {
    const DoubleDouble p = product(x.hi, y), s = ordered_sum(p.hi, x.lo * y);
    return ordered_sum(s.hi, s.lo + p.lo);
  }
  friend DoubleDouble operator*(double x, DoubleDouble y) { return y * x; }

  /// Relative error at most 15 u^2 + 56 u^3.
  friend DoubleDouble operator/(DoubleDouble x, DoubleDouble y) {
    const double quotient = x.hi / y.hi;
    const DoubleDouble r = y * quotient;
    return ordered_sum(quotient, ((x.hi - r.hi) + (x.lo - r.lo)) / y.hi);
  }

  /// Of a number >= 0. Relative error at most 25/8 u^2.
  friend DoubleDouble sqrt(DoubleDouble x) {
    if (!(x.hi > 0)) return {};
    const double root = std::sqrt(x.hi), square = root * root;
    const double rest = (x.hi - square) - Arch::product_error(root, root, square);
    return ordered_sum(root, (x.lo + rest) / (2 * root));
  }

  double value() const { return hi + lo; }
};

/// sum + a b, with a and b exact or with small low parts: in fewer operations than the operators, with an
/// absolute error of at most 4 u^2 (|sum| + |a b|).
template <class Arch>
inline DoubleDouble<Arch> add_product(DoubleDouble<Arch> sum, DoubleDouble<Arch> a, double b) {
  using DD = DoubleDouble<Arch>;
  const DD p = DD::product(a.hi, b), s = DD::sum(sum.hi, p.hi);
  return DD::ordered_sum(s.hi, s.lo + (sum.lo + (p.lo + a.lo * b)));
}

/// a b alone: what add_product makes of a sum of zero.
template <class Arch>
inline DoubleDouble<Arch> first_product(DoubleDouble<Arch> a, double b) {
  using DD = DoubleDouble<Arch>;
  const DD p = DD::product(a.hi, b);
  return DD::ordered_sum(p.hi, p.lo + a.lo * b);
}

/// sum + a b, where a has no low part.
template <class Arch>
inline DoubleDouble<Arch> add_product(DoubleDouble<Arch> sum, double a, double b) {
  using DD = DoubleDouble<Arch>;
  const DD p = DD::product(a, b), s = DD::sum(sum.hi, p.hi);
  return DD::ordered_sum(s.hi, s.lo + (sum.lo + p.lo));
}

/// For what need not be fast.
using Wide = DoubleDouble<SplitProduct>;

}  // namespace lorentz
