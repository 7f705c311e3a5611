// Real numbers of 150 digits and any exponent, for quantities that are reported but decide nothing: margins,
// conditions. Differences that could cancel are taken in integers first. Private to oracle/.
#pragma once

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
  Real(double value);  ///< must be finite
  explicit Real(const Z& value);
  Real(const Real& other);
  Real(Real&& other) noexcept : value_{*other.value_} { other.value_->_mp_d = nullptr; }
  Real& operator=(Real other) noexcept {
    mpf_swap(value_, other.value_);
    return *this;
  }
  ~Real() {
    if (value_->_mp_d) mpf_clear(value_);
  }

  Real& operator+=(const Real& b);
  Real& operator-=(const Real& b);
  Real& operator*=(const Real& b);
  friend Real operator+(Real a, const Real& b) { return std::move(a += b); }
  friend Real operator-(Real a, const Real& b) { return std::move(a -= b); }
  friend Real operator*(Real a, const Real& b) { return std::move(a *= b); }
  friend Real operator/(const Real& a, const Real& b);
  friend Real operator-(Real a);

  friend bool operator==(const Real& a, const Real& b) { return mpf_cmp(a.value_, b.value_) == 0; }
  friend std::strong_ordering operator<=>(const Real& a, const Real& b) {
    return mpf_cmp(a.value_, b.value_) <=> 0;
  }

  friend Real abs(Real a);
  friend Real sqrt(const Real& a);  ///< a >= 0
  friend Real times_power_of_two(Real a, long exponent);
  /// The smallest integer >= a.
  friend Z ceiling(const Real& a);
  /// Truncated to binary64, and at most `most`.
  friend double to_double(const Real& a, double most);
  /// The text that "%.10g" prints.
  friend std::string to_string(const Real& a);

 private:
  static constexpr mp_bitcnt_t kBits = 500;

  mpf_t value_;
};

inline Real real(const Z& a) {
  return Real(a);
}

}  // namespace lorentz::oracle
