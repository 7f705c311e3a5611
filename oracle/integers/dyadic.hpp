// Binary64 values as integers times powers of two. Private to oracle/ and fuzz/rewording.
#pragma once

#include <algorithm>
#include <cmath>

#include "oracle/integers/integer.hpp"

namespace lorentz::oracle {

/// A binary64 as mantissa * 2^exponent. The mantissa is odd, or it is zero and the exponent is 0.
struct Dyadic {
  long mantissa = 0, exponent = 0;

  explicit Dyadic(double value) {
    if (value == 0) return;
    int e = 0;
    mantissa = static_cast<long>(std::ldexp(std::frexp(value, &e), 53));  // exact: 53 bits
    const int zeros = __builtin_ctzl(static_cast<unsigned long>(mantissa));
    mantissa >>= zeros;
    exponent = e - 53L + zeros;
  }
};

/// The smallest exponent of the nonzero values seen: multiplied by 2^-exponent, all of them are integers.
class CommonExponent {
 public:
  void see(double value) {
    if (value == 0) return;
    exponent_ = std::min(exponent_, Dyadic(value).exponent);
    any_ = true;
  }
  long get() const { return any_ ? exponent_ : 0; }

 private:
  long exponent_ = 1 << 20;
  bool any_ = false;
};

/// value * 2^-exponent, which must be an integer.
inline Z scaled(double value, long exponent) {
  const Dyadic d(value);
  return d.mantissa == 0 ? Z(0) : shifted_left(d.mantissa, d.exponent - exponent);
}

}  // namespace lorentz::oracle
