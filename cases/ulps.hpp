// Binary64 values a few ulps away.
#pragma once

#include <cstdint>

#include "cases/random.hpp"

namespace lorentz::cases {

/// x moved by so many ulps, through 0 and the subnormals too; it stops at the largest finite value.
double moved(double x, std::int64_t ulps);

/// Midway between two binary64 values in their order, through 0 and the subnormals too.
double middle(double a, double b);

/// Each of the first `dimension` components moved by -most to most ulps; a zero stays what it is.
void jitter(Random& random, Vec& a, int dimension, std::int64_t most);

/// A number of ulps up to 2^10 either way, small ones as often as large.
std::int64_t drawn_ulps(Random& random);

}  // namespace lorentz::cases
