// Binary64 values as what they are: integers times powers of two. Private to oracle/.
#pragma once

#include <algorithm>
#include <cmath>

#include "integer.hpp"

namespace lorentz::oracle {

/// mantissa * 2^exponent, mantissa odd or zero (then the exponent is 0).
struct Dyadic {
  Z mantissa;
  long exponent = 0;
};

inline Dyadic to_dyadic(double value) {
  if (value == 0) return {};
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  auto mantissa = static_cast<long>(std::ldexp(fraction, 53));  // exact: |fraction| < 1 has 53 bits
  long e = exponent - 53;
  const int zeros = __builtin_ctzl(static_cast<unsigned long>(mantissa));
  return {Z(mantissa >> zeros), e + zeros};
}

/// The smallest exponent of the nonzero values seen: 2^-exponent makes integers of all of them.
class CommonExponent {
 public:
  void see(double value) {
    if (value == 0) return;
    int e = 0;
    const double fraction = std::frexp(value, &e);
    const auto mantissa = static_cast<long>(std::ldexp(fraction, 53));
    exponent_ = std::min(exponent_, e - 53L + __builtin_ctzl(static_cast<unsigned long>(mantissa)));
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
