// Numbers of binary64 or binary32 a few ulps away. An ulp is one of the precision that is asked for.
#pragma once

#include <cstdint>

#include <lorentz/claim.hpp>
#include "cases/random.hpp"

namespace lorentz::cases {

/// Bits of the significand that binary64 has and the precision has not: 0 or 29. An exponent that stands for
/// binary64's last bits stands for the precision's when this is added.
constexpr int missing_bits(NumberFormat precision) {
  return bits_of(NumberFormat::binary64) - bits_of(precision);
}

/// Rounds x to the precision and moves it by `ulps`, through 0 and the subnormals too, at most to the largest finite
/// value.
double moved(double x, std::int64_t ulps, NumberFormat precision = NumberFormat::binary64);

/// Midway between two numbers of the precision in their order, through 0 and the subnormals too.
double middle(double a, double b, NumberFormat precision = NumberFormat::binary64);

/// Each of the first `dimension` components moved by -most to most ulps; a zero stays what it is.
void jitter(Random& random, Vec& a, int dimension, std::int64_t most,
            NumberFormat precision = NumberFormat::binary64);

/// A number of ulps up to 2^10 either way, small ones as often as large.
std::int64_t drawn_ulps(Random& random);

}  // namespace lorentz::cases
