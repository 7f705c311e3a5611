#include "cases/ulps.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace lorentz::cases {
namespace {

// Binary64 values in order, as integers: -0 and +0 both 0.
std::int64_t rank_of(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits < 0 ? std::numeric_limits<std::int64_t>::min() - bits : bits;
}

double of_rank(std::int64_t rank) {
  return std::bit_cast<double>(rank < 0 ? std::numeric_limits<std::int64_t>::min() - rank : rank);
}

}  // namespace

double moved(double x, std::int64_t ulps) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  const double there = of_rank(rank_of(x) + ulps);
  return std::isfinite(there) ? there : std::copysign(kLargest, x);
}

double middle(double a, double b) {
  const std::int64_t one = rank_of(a), other = rank_of(b);
  return of_rank((one >> 1) + (other >> 1) + (one & other & 1));
}

void jitter(Random& random, Vec& a, int dimension, std::int64_t most) {
  for (int i = 0; i < dimension; ++i)
    if (a[i] != 0) a[i] = moved(a[i], random.integer(-most, most));
}

std::int64_t drawn_ulps(Random& random) {
  const std::int64_t most = std::int64_t{1} << random.integer(0, 10);
  return random.integer(1, most) * (random.one_in(2) ? 1 : -1);
}

}  // namespace lorentz::cases
