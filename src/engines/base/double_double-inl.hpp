// Numbers with twice the precision of binary64: unevaluated sums hi + lo with |lo| <= ulp(hi)/2, one number
// or one per lane. Included by double_double.hpp, and by the batch engine once for each set of instructions.
// Arch supplies the number type and the error of a product.
//
// The algorithms and their bounds are those of Joldes, Muller, Popescu, "Tight and rigorous error bounds for
// basic building blocks of double-word arithmetic", ACM TOMS 44 (2017), and, for the square root, of Lefevre,
// Louvet, Muller, Picot, Rideau, ACM TOMS 49 (2023). docs/bounds.md restates them; u = 2^-53.

template <class Arch>
struct DoubleDouble {
  using Number = typename Arch::Number;
  using Mask = typename Arch::Mask;

  Number hi, lo;  // not initialised by default, like a double

  DoubleDouble() = default;
  LORENTZ_INLINE DoubleDouble(Number value) : hi(value), lo(all(0)) {}
  LORENTZ_INLINE DoubleDouble(Number high, Number low) : hi(high), lo(low) {}
  /// The same number in every lane.
  template <class Other>
  LORENTZ_INLINE explicit DoubleDouble(const lorentz::DoubleDouble<Other>& same)
      : hi(all(same.hi)), lo(all(same.lo)) {}

  /// a + b, exact.
  static LORENTZ_INLINE DoubleDouble sum(Number a, Number b) {
    const Number s = a + b, b_part = s - a;
    return {s, (a - (s - b_part)) + (b - b_part)};
  }

  /// a + b, exact if |a| >= |b| or a = 0.
  static LORENTZ_INLINE DoubleDouble ordered_sum(Number a, Number b) {
    const Number s = a + b;
    return {s, b - (s - a)};
  }

  /// a * b, exact within the range that fma.hpp states.
  static LORENTZ_INLINE DoubleDouble product(Number a, Number b) {
    const Number p = a * b;
    return {p, Arch::product_error(a, b, p)};
  }

  LORENTZ_INLINE DoubleDouble operator-() const { return {Neg(hi), Neg(lo)}; }

  /// Relative error at most 3 u^2 + 13 u^3.
  friend LORENTZ_INLINE DoubleDouble operator+(DoubleDouble x, DoubleDouble y) {
    const DoubleDouble s = sum(x.hi, y.hi), t = sum(x.lo, y.lo);
    const DoubleDouble v = ordered_sum(s.hi, s.lo + t.hi);
    return ordered_sum(v.hi, t.lo + v.lo);
  }
  friend LORENTZ_INLINE DoubleDouble operator-(DoubleDouble x, DoubleDouble y) { return x + -y; }

  /// Relative error at most 5 u^2.
  friend LORENTZ_INLINE DoubleDouble operator*(DoubleDouble x, DoubleDouble y) {
    const DoubleDouble p = product(x.hi, y.hi);
    return ordered_sum(p.hi, p.lo + (x.hi * y.lo + x.lo * y.hi));
  }

  /// Relative error at most 3 u^2.
  friend LORENTZ_INLINE DoubleDouble operator*(DoubleDouble x, Number y) {
    const DoubleDouble p = product(x.hi, y), s = ordered_sum(p.hi, x.lo * y);
    return ordered_sum(s.hi, s.lo + p.lo);
  }
  friend LORENTZ_INLINE DoubleDouble operator*(Number x, DoubleDouble y) { return y * x; }

  /// Relative error at most 15 u^2 + 56 u^3.
  friend LORENTZ_INLINE DoubleDouble operator/(DoubleDouble x, DoubleDouble y) {
    const Number quotient = x.hi / y.hi;
    const DoubleDouble r = y * quotient;
    return ordered_sum(quotient, ((x.hi - r.hi) + (x.lo - r.lo)) / y.hi);
  }

  /// The square root of a number >= 0; 0 for other numbers. Relative error at most 25/8 u^2.
  friend LORENTZ_INLINE DoubleDouble sqrt(DoubleDouble x) {
    const Mask above = x.hi > all(0);
    if (nowhere(above)) return all(0);
    const Number root = sqrt(x.hi), square = root * root;
    const Number rest = (x.hi - square) - Arch::product_error(root, root, square);
    return select(above, ordered_sum(root, (x.lo + rest) / (root + root)), DoubleDouble(all(0)));
  }

  friend LORENTZ_INLINE DoubleDouble select(Mask m, DoubleDouble yes, DoubleDouble no) {
    return {select(m, yes.hi, no.hi), select(m, yes.lo, no.lo)};
  }

  friend LORENTZ_INLINE DoubleDouble NegIf(Mask m, DoubleDouble x) {
    return {NegIf(m, x.hi), NegIf(m, x.lo)};
  }

  LORENTZ_INLINE Number value() const { return hi + lo; }
};

/// sum + a b, where a and b are exact or have small low parts: in fewer operations than the operators take,
/// with an absolute error of at most 4 u^2 (|sum| + |a b|).
template <class Arch>
LORENTZ_INLINE DoubleDouble<Arch> add_product(DoubleDouble<Arch> sum, DoubleDouble<Arch> a,
                                              typename Arch::Number b) {
  using DD = DoubleDouble<Arch>;
  const DD p = DD::product(a.hi, b), s = DD::sum(sum.hi, p.hi);
  return DD::ordered_sum(s.hi, s.lo + (sum.lo + (p.lo + a.lo * b)));
}

/// a b: the result of add_product for a sum of zero.
template <class Arch>
LORENTZ_INLINE DoubleDouble<Arch> first_product(DoubleDouble<Arch> a, typename Arch::Number b) {
  using DD = DoubleDouble<Arch>;
  const DD p = DD::product(a.hi, b);
  return DD::ordered_sum(p.hi, p.lo + a.lo * b);
}

/// sum + a b, where a has no low part.
template <class Arch>
LORENTZ_INLINE DoubleDouble<Arch> add_product(DoubleDouble<Arch> sum, typename Arch::Number a,
                                              typename Arch::Number b) {
  using DD = DoubleDouble<Arch>;
  const DD p = DD::product(a, b), s = DD::sum(sum.hi, p.hi);
  return DD::ordered_sum(s.hi, s.lo + (sum.lo + p.lo));
}
