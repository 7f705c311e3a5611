// Polynomials with integer coefficients, and Euclid's algorithm on them. Private to oracle/.
#pragma once

#include <vector>

#include "oracle/integers/integer.hpp"

namespace lorentz::oracle {

class Polynomial {
 public:
  Polynomial() = default;
  /// The coefficients of 1, x, x^2, ..
  Polynomial(std::initializer_list<Z> coefficients) : Polynomial(std::vector<Z>(coefficients)) {}
  explicit Polynomial(std::vector<Z> coefficients);

  bool is_zero() const { return terms_.empty(); }
  /// The degree plus 1; 0 for the polynomial 0.
  std::size_t size() const { return terms_.size(); }
  /// 0 beyond the degree.
  const Z& operator[](std::size_t k) const;
  /// The coefficient of the highest power. The polynomial must not be 0.
  const Z& back() const { return terms_.back(); }

  friend Polynomial operator+(const Polynomial& a, const Polynomial& b) { return sum(a, b, 1); }
  friend Polynomial operator-(const Polynomial& a, const Polynomial& b) { return sum(a, b, -1); }
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b);

 private:
  static Polynomial sum(const Polynomial& a, const Polynomial& b, int sign);

  std::vector<Z> terms_;  // the last one is not zero
};

Polynomial derivative(const Polynomial& p);

/// Divided by the greatest common divisor of its coefficients.
Polynomial primitive(const Polynomial& p);

/// a, b, and the remainders of Euclid's algorithm with alternating signs, each times a positive number. The
/// last one is the greatest common divisor. For p and its derivative this is Sturm's chain: the number of
/// different roots of p between two points is the number of sign changes of the chain at the first point
/// minus that at the second.
std::vector<Polynomial> remainders(const Polynomial& a, const Polynomial& b);

/// The number of sign changes along the chain; zeros are skipped.
template <class SignOf>
int sign_changes(const std::vector<Polynomial>& chain, const SignOf& sign_of) {
  int changes = 0, before = 0;
  for (const Polynomial& p : chain) {
    const int sign = sign_of(p);
    changes += sign * before < 0;
    if (sign != 0) before = sign;
  }
  return changes;
}

}  // namespace lorentz::oracle
