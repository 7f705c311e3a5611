// Moves binary64 or binary32 numbers by a few ulps. An ulp is one of the requested precision.
#pragma once

#include <cstdint>

#include <lorentz/claim.hpp>
#include "question/cases/random.hpp"

namespace lorentz::cases {

/// The bits of binary64's significand that the precision lacks: 0 or 29. Adding them to an exponent that
/// stands for binary64's last bits gives the exponent for the precision's last bits.
constexpr int missing_bits(NumberFormat precision) {
  return bits_of(NumberFormat::binary64) - bits_of(precision);
}

/// Rounds x to the precision and moves it by `ulps`, through 0 and the subnormals too, at most to the largest
/// finite value.
double moved(double x, std::int64_t ulps, NumberFormat precision = NumberFormat::binary64);

/// The same, but a zero becomes `ulps` times `unit`.
double nudged(double x, std::int64_t ulps, double unit, NumberFormat precision);

/// The number midway between two numbers of the precision in their order, through 0 and the subnormals too.
double middle(double a, double b, NumberFormat precision = NumberFormat::binary64);

/// Moves each of the first `dimension` components by -most to most ulps; a zero stays zero.
void jitter(Random& random, Vec& a, int dimension, std::int64_t most,
            NumberFormat precision = NumberFormat::binary64);

/// A drawn number of ulps up to 2^10 either way, small ones as often as large.
std::int64_t drawn_ulps(Random& random);

}  // namespace lorentz::cases
