// Sums without rounding, held against GMP's rationals.
#include <catch2/catch.hpp>

#include <gmpxx.h>

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "question/cases/random.hpp"
#include "src/exchange/json_piece.hpp"
#include "statistics/flights/exact_sum.hpp"

using lorentz::cases::Random;
using lorentz::flights::ExactSum;

namespace {

// Any finite number, of any exponent, subnormal ones included.
double drawn(Random& random) {
  for (;;) {
    const double x = std::bit_cast<double>(random.bits());
    if (std::isfinite(x)) return x;
  }
}

std::vector<double> numbers(std::uint64_t seed, int count, bool near) {
  Random random(seed, "exact sums", 0);
  std::vector<double> all;
  for (int i = 0; i < count; ++i)
    all.push_back(near ? random.octave(-3, 3) * random.sign() : drawn(random) * 0x1p-10);
  return all;
}

ExactSum sum_of(const std::vector<double>& numbers, std::size_t begin, std::size_t end) {
  ExactSum sum;
  for (std::size_t i = begin; i < end; ++i) sum.add(numbers[i]);
  return sum;
}

// The nearest binary64, half to even, by exact comparison with the neighbours of GMP's truncation.
double nearest(const mpq_class& q) {
  double best = q.get_d();
  for (const double other : {std::nextafter(best, -HUGE_VAL), std::nextafter(best, HUGE_VAL)}) {
    if (!std::isfinite(other)) continue;
    const mpq_class here = abs(q - mpq_class(best)), there = abs(q - mpq_class(other));
    if (there < here || (there == here && (std::bit_cast<std::uint64_t>(other) & 1) == 0)) best = other;
  }
  return best;
}

}  // namespace

TEST_CASE("A sum is the exact one, rounded once", "[flights]") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    for (const bool near : {false, true}) {
      const std::vector<double> all = numbers(seed, 1 + static_cast<int>(seed), near);
      mpq_class exact = 0;
      for (const double x : all) exact += mpq_class(x);
      INFO("seed " << seed << (near ? ", numbers of like size" : ", of any size"));
      CHECK(sum_of(all, 0, all.size()).value() == nearest(exact));
    }
  // Ties, and sums among the subnormal numbers.
  ExactSum tie;
  for (const double x : {1.0, 0x1p-53}) tie.add(x);
  CHECK(tie.value() == 1);
  tie.add(0x1p-52);
  CHECK(tie.value() == 1 + 0x1p-51);
  tie.add(-0x1p-1074);
  CHECK(tie.value() == 1 + 0x1p-52);
  for (const double low : {0x1p-100, 0x1p-180, 0x1p-1074}) {  // what breaks a tie may lie far below
    ExactSum broken;
    for (const double x : {1.0, 0x1p-53, low}) broken.add(x);
    CHECK(broken.value() == 1 + 0x1p-52);
  }
  ExactSum tiny;
  for (int i = 0; i < 3; ++i) tiny.add(0x1p-1074);
  CHECK(tiny.value() == 3 * 0x1p-1074);
  ExactSum none;
  CHECK(none.value() == 0);
  none.add(-0.0);
  CHECK(none.value() == 0);
  ExactSum large;
  for (int i = 0; i < 2; ++i) large.add(std::numeric_limits<double>::max());
  CHECK(large.value() == HUGE_VAL);
  large.add(-std::numeric_limits<double>::max());
  CHECK(large.value() == std::numeric_limits<double>::max());
}

TEST_CASE("A sum does not depend on how it is split, and survives being written", "[flights]") {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const std::vector<double> all = numbers(seed, 100, seed % 2 == 0);
    const ExactSum whole = sum_of(all, 0, all.size());
    for (const std::size_t cut : {std::size_t{0}, std::size_t{1}, std::size_t{37}, all.size()}) {
      ExactSum second = sum_of(all, cut, all.size());
      second.add(sum_of(all, 0, cut));
      CHECK(second == whole);
      CHECK(lorentz::json::piece_of(second) == lorentz::json::piece_of(whole));
      ExactSum read;
      lorentz::json::read_piece(lorentz::json::piece_of(second), read);
      CHECK(read == whole);
    }
  }
}

TEST_CASE("A sum of very many numbers does not overflow", "[flights]") {
  // 2^30 additions and more between two of its carries would take seconds; so its digits are filled by sums
  // of sums.
  ExactSum sum;
  sum.add(std::nextafter(1.0, 0));
  double expected = std::nextafter(1.0, 0);
  for (int doubling = 0; doubling < 60; ++doubling) {
    sum.add(ExactSum(sum));
    expected *= 2;
    CHECK(sum.value() == expected);
  }
}
