#include "oracle/itinerary/ball.hpp"

#include <flint/fmpz.h>

#include "oracle/exact/quadratic.hpp"

namespace lorentz::oracle {
namespace {

// FLINT's integers.
class FlintInteger {
 public:
  FlintInteger() { fmpz_init(value_); }
  FlintInteger(const FlintInteger&) = delete;
  ~FlintInteger() { fmpz_clear(value_); }

  fmpz_t& raw() { return value_; }
  Z z() const {
    mpz_t copy;
    mpz_init(copy);
    fmpz_get_mpz(copy, value_);
    Z result(static_cast<mpz_srcptr>(copy));
    mpz_clear(copy);
    return result;
  }

 private:
  fmpz_t value_;
};

}  // namespace

Bound Ball::size() const {
  Bound result;
  arb_get_mag(result.value_, value_);
  return result;
}

Bound Ball::least_size() const {
  Bound result;
  arb_get_mag_lower(result.value_, value_);
  return result;
}

Ball Ball::widened(const Bound& by) const {
  Ball result = *this;
  arb_add_error_mag(result.value_, by.value_);
  return result;
}

Ball Ball::middle() const {
  Ball result;
  arb_get_mid_arb(result.value_, value_);
  return result;
}

Z Ball::rounded(long bits) const {
  FlintInteger integer;
  arf_get_fmpz(integer.raw(), arb_midref(scaled(*this, bits).value_), ARF_RND_NEAR);
  return integer.z();
}

Ball::Exact Ball::exact_middle() const {
  FlintInteger integer, exponent;
  arf_get_fmpz_2exp(integer.raw(), exponent.raw(), arb_midref(value_));
  return {integer.z(), fmpz_get_si(exponent.raw())};
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
