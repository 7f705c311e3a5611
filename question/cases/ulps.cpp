#include "question/cases/ulps.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace lorentz::cases {
namespace {

// The rank of a number in the order of its format, as an integer; -0 and +0 both have rank 0. The integers of
// negative numbers are mirrored at the format's least integer.
template <class Bits, class Number>
std::int64_t rank_of(Number x) {
  const auto bits = std::bit_cast<Bits>(x);
  return bits < 0 ? std::numeric_limits<Bits>::min() - bits : bits;
}

template <class Number, class Bits>
double of_rank(Bits rank) {
  return std::bit_cast<Number>(rank < 0 ? std::numeric_limits<Bits>::min() - rank : rank);
}

std::int64_t rank_of(double x, NumberFormat precision) {
  return precision == NumberFormat::binary64 ? rank_of<std::int64_t>(x)
                                             : rank_of<std::int32_t>(static_cast<float>(x));
}

double of_rank(std::int64_t rank, NumberFormat precision) {
  return precision == NumberFormat::binary64 ? of_rank<double>(rank)
                                             : of_rank<float>(static_cast<std::int32_t>(rank));
}

double largest(NumberFormat precision) {
  return precision == NumberFormat::binary64 ? std::numeric_limits<double>::max()
                                             : std::numeric_limits<float>::max();
}

}  // namespace

double moved(double x, std::int64_t ulps, NumberFormat precision) {
  const double there = of_rank(rank_of(x, precision) + ulps, precision);
  return std::isfinite(there) ? there : std::copysign(largest(precision), x);
}

double nudged(double x, std::int64_t ulps, double unit, NumberFormat precision) {
  return x == 0 ? static_cast<double>(ulps) * unit : moved(x, ulps, precision);
}

double middle(double a, double b, NumberFormat precision) {
  const std::int64_t one = rank_of(a, precision), other = rank_of(b, precision);
  return of_rank((one >> 1) + (other >> 1) + (one & other & 1), precision);
}

void jitter(Random& random, Vec& a, int dimension, std::int64_t most, NumberFormat precision) {
  for (int i = 0; i < dimension; ++i)
    if (a[i] != 0) a[i] = moved(a[i], random.integer(-most, most), precision);
}

std::int64_t drawn_ulps(Random& random) {
  const std::int64_t most = std::int64_t{1} << random.integer(0, 10);
  return random.integer(1, most) * (random.one_in(2) ? 1 : -1);
}

}  // namespace lorentz::cases
