// Binary64 values as integers times powers of two. Private to oracle/ and fuzz/rewording.
#pragma once

#include <algorithm>
#include <cmath>

#include "oracle/integers/integer.hpp"

namespace lorentz::oracle {

/// mantissa * 2^exponent. The mantissa is odd, or it is zero and the exponent is 0.
struct Dyadic {
  Z mantissa;
  long exponent = 0;
};

/// A binary64 other than 0 as mantissa * 2^exponent with an odd mantissa.
struct OddMantissa {
  long mantissa, exponent;

  explicit OddMantissa(double value) {
    int e = 0;
    mantissa = static_cast<long>(std::ldexp(std::frexp(value, &e), 53));  // exact: 53 bits
    const int zeros = __builtin_ctzl(static_cast<unsigned long>(mantissa));
    mantissa >>= zeros;
    exponent = e - 53L + zeros;
  }
};

inline Dyadic to_dyadic(double value) {
  if (value == 0) return {};
  const OddMantissa odd(value);
  return {Z(odd.mantissa), odd.exponent};
}

/// The smallest exponent of the nonzero values seen: multiplied by 2^-exponent, all of them are integers.
class CommonExponent {
 public:
  void see(double value) {
    if (value == 0) return;
    exponent_ = std::min(exponent_, OddMantissa(value).exponent);
    any_ = true;
  }
  long get() const { return any_ ? exponent_ : 0; }

 private:
  long exponent_ = 1 << 20;
  bool any_ = false;
};

/// value * 2^-exponent, which must be an integer.
inline Z scaled(double value, long exponent) {
  Dyadic d = to_dyadic(value);
  return d.mantissa == 0 ? Z(0) : shifted_left(d.mantissa, d.exponent - exponent);
}

}  // namespace lorentz::oracle
