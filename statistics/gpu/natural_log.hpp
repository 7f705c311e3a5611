// The natural logarithm in plain operations of binary64: the same bits on every machine, and on a graphics
// card. The last bits of library functions differ.
#pragma once

#include <bit>
#include <cstdint>

namespace lorentz::gpu {

/// ln x for x > 0, with an error below 2 10^-16 (1 + |ln x|).
///
/// x = 2^k m with m between 1/sqrt(2) and sqrt(2), and ln m = 2 (s + s^3/3 + s^5/5 + ..) where
/// s = (m - 1)/(m + 1), so that |s| < 0.172. The terms that are left out begin with 2 s^23/23 < 3 10^-19. k
/// times the first part of ln 2, which has 33 bits, is exact.
inline double natural_log(double x) {
  constexpr double kLn2High = 0x1.62e42fefp-1, kLn2Low = 0x1.473de6af278edp-34;
  int k = -1023;
  if (x < 0x1p-1022) x *= 0x1p54, k -= 54;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  k += static_cast<int>(bits >> 52);
  double m = std::bit_cast<double>((bits & 0xfffffffffffff) | 0x3ff0000000000000);
  if (m > 0x1.6a09e667f3bcdp0) m = m / 2, ++k;
  const double f = m - 1, s = f / (m + 1), z = s * s;
  double sum = 1.0 / 21;
  sum = sum * z + 1.0 / 19;
  sum = sum * z + 1.0 / 17;
  sum = sum * z + 1.0 / 15;
  sum = sum * z + 1.0 / 13;
  sum = sum * z + 1.0 / 11;
  sum = sum * z + 1.0 / 9;
  sum = sum * z + 1.0 / 7;
  sum = sum * z + 1.0 / 5;
  sum = sum * z + 1.0 / 3;
  const double rest = s * (z * sum);  // ln m = 2 s + 2 rest
  return k * kLn2High + (2 * s + (2 * rest + k * kLn2Low));
}

}  // namespace lorentz::gpu
