// Real numbers of 150 digits and any exponent, for quantities that are reported but decide nothing: margins,
// conditions. Differences that could cancel are taken in integers first. Private to oracle/.
#pragma once

#include <array>
#include <compare>
#include <string>
#include <utility>

#include "oracle/integers/integer.hpp"

namespace lorentz::oracle {

/// GMP's mpf_t as a value type. Results are truncated. No operation overflows. Division by 0 throws
/// std::overflow_error.
class Real {
 public:
  Real() { mpf_init2(value_, kBits); }
  Real(double value) : Real() { mpf_set_d(value_, value); }  ///< must be finite
  explicit Real(const Z& value) : Real() { mpf_set_z(value_, value.view()); }
  Real(const Real& other) : Real() { mpf_set(value_, other.value_); }
  Real(Real&& other) noexcept : value_{*other.value_} { other.value_->_mp_d = nullptr; }
  Real& operator=(Real other) noexcept {
    mpf_swap(value_, other.value_);
    return *this;
  }
  ~Real() {
    if (value_->_mp_d) mpf_clear(value_);
  }

  Real& operator+=(const Real& b) {
    mpf_add(value_, value_, b.value_);
    return *this;
  }
  Real& operator-=(const Real& b) {
    mpf_sub(value_, value_, b.value_);
    return *this;
  }
  Real& operator*=(const Real& b) {
    mpf_mul(value_, value_, b.value_);
    return *this;
  }
  friend Real operator+(Real a, const Real& b) { return std::move(a += b); }
  friend Real operator-(Real a, const Real& b) { return std::move(a -= b); }
  friend Real operator*(Real a, const Real& b) { return std::move(a *= b); }
  friend Real operator/(Real a, const Real& b) {
    if (mpf_sgn(b.value_) == 0) throw std::overflow_error("a real number is divided by 0");
    mpf_div(a.value_, a.value_, b.value_);
    return a;
  }
  friend Real operator-(Real a) {
    mpf_neg(a.value_, a.value_);
    return a;
  }

  friend bool operator==(const Real& a, const Real& b) { return mpf_cmp(a.value_, b.value_) == 0; }
  friend std::strong_ordering operator<=>(const Real& a, const Real& b) {
    return mpf_cmp(a.value_, b.value_) <=> 0;
  }

  friend Real abs(Real a) {
    mpf_abs(a.value_, a.value_);
    return a;
  }
  friend Real sqrt(Real a) {  ///< a >= 0
    mpf_sqrt(a.value_, a.value_);
    return a;
  }
  friend Real times_power_of_two(Real a, long exponent) {
    if (exponent < 0)
      mpf_div_2exp(a.value_, a.value_, -static_cast<mp_bitcnt_t>(exponent));
    else
      mpf_mul_2exp(a.value_, a.value_, static_cast<mp_bitcnt_t>(exponent));
    return a;
  }
  /// The smallest integer >= a.
  friend Z ceiling(const Real& a) {
    Real rounded;
    mpf_ceil(rounded.value_, a.value_);
    return Z(rounded.value_);
  }
  /// Truncated to binary64, and at most `most`.
  friend double to_double(const Real& a, double most) { return a >= most ? most : mpf_get_d(a.value_); }
  friend Estimate estimate(const Real& a) {
    BinaryApproximation its;
    its.mantissa = mpf_get_d_2exp(&its.exponent, a.value_);
    return estimate(its);
  }
  /// The text that "%.10g" prints.
  friend std::string to_string(const Real& a) {
    std::array<char, 64> text;  // 10 digits, signs, and an exponent of at most 20 digits
    gmp_snprintf(text.data(), text.size(), "%.10Fg", a.value_);
    return text.data();
  }

 private:
  static constexpr mp_bitcnt_t kBits = 500;

  mpf_t value_;
};

inline Real real(const Z& a) {
  return Real(a);
}

}  // namespace lorentz::oracle
