#include "oracle/exact/real.hpp"

#include <array>
#include <stdexcept>

namespace lorentz::oracle {

Real::Real(double value) : Real() {
  mpf_set_d(value_, value);
}
Real::Real(const Z& value) : Real() {
  mpf_set_z(value_, value.view());
}
Real::Real(const Real& other) : Real() {
  mpf_set(value_, other.value_);
}

Real& Real::operator+=(const Real& b) {
  mpf_add(value_, value_, b.value_);
  return *this;
}
Real& Real::operator-=(const Real& b) {
  mpf_sub(value_, value_, b.value_);
  return *this;
}
Real& Real::operator*=(const Real& b) {
  mpf_mul(value_, value_, b.value_);
  return *this;
}

Real operator/(const Real& a, const Real& b) {
  if (mpf_sgn(b.value_) == 0) throw std::overflow_error("a real number is divided by 0");
  Real quotient;
  mpf_div(quotient.value_, a.value_, b.value_);
  return quotient;
}

Real operator-(Real a) {
  mpf_neg(a.value_, a.value_);
  return a;
}

Real abs(Real a) {
  mpf_abs(a.value_, a.value_);
  return a;
}

Real sqrt(const Real& a) {
  Real root;
  mpf_sqrt(root.value_, a.value_);
  return root;
}

Real times_power_of_two(Real a, long exponent) {
  if (exponent < 0)
    mpf_div_2exp(a.value_, a.value_, -static_cast<mp_bitcnt_t>(exponent));
  else
    mpf_mul_2exp(a.value_, a.value_, static_cast<mp_bitcnt_t>(exponent));
  return a;
}

Z ceiling(const Real& a) {
  Real rounded;
  mpf_ceil(rounded.value_, a.value_);
  mpz_t integer;
  mpz_init(integer);
  mpz_set_f(integer, rounded.value_);
  Z result(integer);
  mpz_clear(integer);
  return result;
}

double to_double(const Real& a, double most) {
  return a >= most ? most : mpf_get_d(a.value_);
}

std::string to_string(const Real& a) {
  std::array<char, 64> text;  // 10 digits, signs, and an exponent of at most 20 digits
  gmp_snprintf(text.data(), text.size(), "%.10Fg", a.value_);
  return text.data();
}

}  // namespace lorentz::oracle
