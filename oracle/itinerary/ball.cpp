#include "oracle/itinerary/ball.hpp"

#include <flint/fmpz.h>

#include "oracle/exact/quadratic.hpp"

namespace lorentz::oracle {
namespace {

Z z_of(const fmpz_t integer) {
  mpz_t copy;
  mpz_init(copy);
  fmpz_get_mpz(copy, integer);
  Z result(static_cast<mpz_srcptr>(copy));
  mpz_clear(copy);
  return result;
}

// A binary fraction times 2^bits, rounded to an integer.
Z rounded_arf(const arf_t value, long bits, arf_rnd_t rounding) {
  arf_t scaled;
  fmpz_t integer;
  arf_init(scaled);
  fmpz_init(integer);
  arf_mul_2exp_si(scaled, value, bits);
  arf_get_fmpz(integer, scaled, rounding);
  Z result = z_of(integer);
  fmpz_clear(integer);
  arf_clear(scaled);
  return result;
}

}  // namespace

long Bound::exponent() const {
  fmpz_t exponent;
  fmpz_init(exponent);
  fmpz_set(exponent, MAG_EXPREF(value_));
  const long result = fmpz_get_si(exponent);
  fmpz_clear(exponent);
  return result;
}

Bound Ball::size() const {
  mag_t size;
  mag_init(size);
  arb_get_mag(size, value_);
  Bound result(size);
  mag_clear(size);
  return result;
}

Bound Ball::least_size() const {
  mag_t size;
  mag_init(size);
  arb_get_mag_lower(size, value_);
  Bound result(size);
  mag_clear(size);
  return result;
}

Ball Ball::widened(const Bound& by) const {
  Ball result = *this;
  mag_add(arb_radref(result.value_), arb_radref(result.value_), by.raw());
  return result;
}

Ball Ball::middle() const {
  Ball result;
  arb_get_mid_arb(result.value_, value_);
  return result;
}

Z Ball::rounded(long bits) const {
  return rounded_arf(arb_midref(value_), bits, ARF_RND_NEAR);
}

Ball::Exact Ball::exact_middle() const {
  fmpz_t integer, exponent;
  fmpz_init(integer);
  fmpz_init(exponent);
  arf_get_fmpz_2exp(integer, exponent, arb_midref(value_));
  Exact result{z_of(integer), fmpz_get_si(exponent)};
  fmpz_clear(integer);
  fmpz_clear(exponent);
  return result;
}

Ball Ball::lower() const {
  Ball result;
  arb_get_lbound_arf(arb_midref(result.value_), value_, WorkingPrecision::now());
  return result;
}

Ball Ball::upper() const {
  Ball result;
  arb_get_ubound_arf(arb_midref(result.value_), value_, WorkingPrecision::now());
  return result;
}

std::optional<std::string> certain_decimal(const Ball& a, int digits) {
  constexpr double kBitsADigit = 3.33;
  const Ball::WorkingPrecision enough(static_cast<long>(kBitsADigit * digits) + 64);
  if (!a.is_finite()) return std::nullopt;
  if (!a.is_positive() && !a.is_negative()) {
    if (a.is_exact()) return "0";
    return std::nullopt;
  }
  const auto text = [&](const Ball& end) {
    const Ball::Exact exact = end.exact_middle();
    return round_to_decimal(Quadratic{abs(exact.integer), +1, 0, 1, exact.exponent}, digits);
  };
  const std::string low = text(a.lower());
  if (low != text(a.upper())) return std::nullopt;
  return a.is_negative() ? "-" + low : low;
}

}  // namespace lorentz::oracle
