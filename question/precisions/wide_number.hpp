// What the search needs of double-double numbers besides their arithmetic (src/engines/base): comparisons,
// rounding to integers, and conversion to answers. It is in the namespace of the numbers, where templates
// look for it.
#pragma once

#include <cmath>
#include <compare>
#include <limits>

#include "src/engines/base/double_double.hpp"
#include "src/engines/published/published_unit.hpp"

namespace lorentz {

inline bool operator==(Wide a, Wide b) {
  return a.hi == b.hi && a.lo == b.lo;
}
inline std::partial_ordering operator<=>(Wide a, Wide b) {
  return a.hi == b.hi ? a.lo <=> b.lo : a.hi <=> b.hi;
}

inline Wide& operator+=(Wide& a, Wide b) {
  return a = a + b;
}
inline Wide& operator-=(Wide& a, Wide b) {
  return a = a - b;
}

inline Wide fabs(Wide a) {
  return a.hi < 0 ? -a : a;
}
inline Wide copysign(Wide size, Wide sign) {
  return std::signbit(sign.hi) == std::signbit(size.hi) ? size : -size;
}
inline Wide floor(Wide a) {
  const double whole = std::floor(a.hi);
  return whole == a.hi ? Wide::ordered_sum(whole, std::floor(a.lo)) : Wide(whole);
}
inline Wide round(Wide a) {  // halves away from zero
  return a.hi < 0 ? -floor(-a + 0.5) : floor(a + 0.5);
}

template <>
struct published_search::NumberType<Wide> {
  static constexpr int kDigits = 104;  // two of the 106 are left to the errors of sums
  static double binary64(Wide a) { return a.value(); }
  static Integer integer(Wide a) {
    if (!(std::fabs(a.hi) < 0x1p126)) return {};  // overflow: the answer's time is not finite either
    const WideInteger n = static_cast<WideInteger>(a.hi) + static_cast<WideInteger>(a.lo);
    if (n >= std::numeric_limits<std::int64_t>::min() && n <= std::numeric_limits<std::int64_t>::max())
      return static_cast<std::int64_t>(n);
    std::string digits;
    for (WideInteger rest = n < 0 ? -n : n; rest > 0; rest /= 10)
      digits.insert(digits.begin(), static_cast<char>('0' + static_cast<int>(rest % 10)));
    return Integer::from_decimal(n < 0 ? '-' + digits : digits).value();
  }
};

}  // namespace lorentz
