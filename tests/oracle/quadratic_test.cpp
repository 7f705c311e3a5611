// Rounding and comparison of quadratic numbers, against MPFR at a precision that decides them all.
#include "oracle/exact/quadratic.hpp"

#include <boost/multiprecision/mpfr.hpp>
#include <catch2/catch.hpp>

#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::oracle;
using test::Draw;

namespace {

using Big =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<400>>;  // 400 decimal digits

Big big(const Z& a) {
  return Big(a.get_str());
}

Big value_of(const Quadratic& n) {
  return (big(n.a) + n.sign * sqrt(big(n.d))) / big(n.q) * pow(Big(2), n.exponent);
}

Z random_bits(Draw& draw, int bits) {
  Z a = 0;
  for (int i = 0; i < bits; i += 32) a = (a << 32) + static_cast<unsigned long>(draw.below(1ull << 32));
  return a >> ((32 - bits % 32) % 32);
}

// a and sqrt(d) of all sizes; often nearly equal, so that they cancel.
Quadratic drawn(Draw& draw) {
  Quadratic n;
  n.a = random_bits(draw, 1 + static_cast<int>(draw.below(200)));
  n.d = draw.one_in(2) ? random_bits(draw, 1 + static_cast<int>(draw.below(400)))
                       : Z(n.a * n.a + draw.below(5) - 2);
  if (draw.one_in(4)) n.d = n.a * n.a - n.a;
  if (n.d < 0) n.d = 0;
  if (draw.one_in(3)) n.a = -n.a;
  n.sign = draw.one_in(2) ? 1 : -1;
  n.q = 1 + random_bits(draw, 1 + static_cast<int>(draw.below(150)));
  n.exponent = static_cast<long>(draw.below(2400)) - 1300;
  return n;
}

}  // namespace

TEST_CASE("Rounding to binary64 agrees with MPFR", "[oracle][quadratic]") {
  Draw draw(31);
  INFO("seed 31");
  int subnormal = 0, infinite = 0, negative = 0;
  for (int i = 0; i < 20000; ++i) {
    const Quadratic n = drawn(draw);
    // Two roundings (to 400 digits, then to 53 bits) would differ only for a number within 1e-400 of a
    // midpoint.
    const Big value = value_of(n);
    const double given = round_to_binary64(n);
    INFO("a " << n.a << " sign " << n.sign << " d " << n.d << " q " << n.q << " exponent " << n.exponent);
    if (std::isinf(given)) {
      REQUIRE(abs(value) >= pow(Big(2), 1024) - pow(Big(2), 970));
      ++infinite;
      continue;
    }
    // Nearest: no neighbour is nearer; a tie goes to the even one.
    const double up = std::nextafter(given, INFINITY), down = std::nextafter(given, -INFINITY);
    const Big miss = abs(value - Big(given));
    if (std::isfinite(up)) REQUIRE(miss <= abs(value - Big(up)));
    if (std::isfinite(down)) REQUIRE(miss <= abs(value - Big(down)));
    subnormal += given != 0 && std::fabs(given) < 0x1p-1022;
    negative += given < 0;
  }
  CHECK(subnormal > 340);  // 432 seen
  CHECK(infinite > 580);   // 726 seen
  CHECK(negative > 5200);  // 6 586 seen
}

TEST_CASE("Ties go to the even neighbour, in the normal and the subnormal range, and at the top",
          "[oracle][quadratic]") {
  const auto rounded = [](const Z& a, long exponent) { return round_to_binary64({a, +1, 0, 1, exponent}); };
  const Z even = (Z(1) << 53) + 2;
  CHECK(rounded(even * 2 + 2, 0) ==
        0x1p54 + 8);  // halfway between 2^54 + 4 and 2^54 + 8: mantissas odd and even
  CHECK(rounded((Z(1) << 54) + 2, 0) == 0x1p54);
  CHECK(rounded((Z(1) << 54) + 6, 0) == 0x1p54 + 8);
  CHECK(rounded(1, -1075) == 0.0);  // half the smallest: to zero
  CHECK(rounded(3, -1075) == 0x1p-1073);
  CHECK(round_to_binary64({(Z(1) << 60) + 1, +1, 0, 1, -1135}) == 0x1p-1074);  // just above half the smallest
  CHECK(std::isinf(rounded((Z(1) << 54) - 1, 970)));  // exactly between the largest and 2^1024
  CHECK(rounded((Z(1) << 55) - 3, 969) == std::numeric_limits<double>::max());
  CHECK_FALSE(std::signbit(rounded(0, 0)));
  // An irrational a hair off the midpoint: (2^54 + 2) +- 2^-200, as a root.
  const Z middle = ((Z(1) << 54) + 2) << 200;
  CHECK(round_to_binary64({0, +1, middle * middle + 1, 1, -200}) == 0x1p54 + 4);
  CHECK(round_to_binary64({0, +1, middle * middle - 1, 1, -200}) == 0x1p54);
}

TEST_CASE("Decimal digits are rounded half to even", "[oracle][quadratic]") {
  const auto decimal = [](long a, long q, int digits) {
    return round_to_decimal({Z(a), +1, 0, Z(q), 0}, digits);
  };
  CHECK(decimal(1, 4, 1) == "0.2");
  CHECK(decimal(3, 4, 1) == "0.8");
  CHECK(decimal(1, 8, 2) == "0.12");
  CHECK(decimal(3, 8, 2) == "0.38");
  CHECK(decimal(25, 1, 1) == "2e+1");
  CHECK(decimal(9995, 1, 3) == "1.00e+4");
  CHECK(decimal(2, 3, 5) == "0.66667");
  CHECK(decimal(-2, 3, 5) == "-0.66667");
  CHECK(decimal(1, 1, 5) == "1.0000");
  CHECK(decimal(123, 1, 3) == "123");
  CHECK(decimal(0, 1, 3) == "0");
  CHECK(round_to_decimal({0, +1, 2, 1, 0}, 50) == "1.4142135623730950488016887242096980785696718753769");
  CHECK(round_to_decimal({1, -1, 0, 1, -1074}, 5) == "4.9407e-324");
}

TEST_CASE("Decimal digits agree with MPFR", "[oracle][quadratic]") {
  Draw draw(32);
  INFO("seed 32");
  for (int i = 0; i < 3000; ++i) {
    const Quadratic n = drawn(draw);
    if (sign_of(n.a, n.sign, n.d) == 0) continue;
    const int digits = 1 + static_cast<int>(draw.below(60));
    const Big value = value_of(n), given(round_to_decimal(n, digits));
    INFO("a " << n.a << " sign " << n.sign << " d " << n.d << " q " << n.q << " exponent " << n.exponent
              << " digits " << digits);
    // Within half a unit of the last digit, 10^(floor(log10 |value|) + 1 - digits) or, rounded up to a power
    // of ten, less.
    const Big unit = pow(Big(10), floor(log10(abs(value))) + 1 - digits);
    REQUIRE(abs(value - given) <= unit / 2 * (1 + Big("1e-300")));
  }
}

TEST_CASE("Entries compare as MPFR says, and exactly where they are equal", "[oracle][quadratic]") {
  Draw draw(33);
  INFO("seed 33");
  int equal = 0;
  for (int i = 0; i < 20000; ++i) {
    const Z s1 = random_bits(draw, 60), d1 = random_bits(draw, 1 + static_cast<int>(draw.below(120)));
    // Half the time the same number written otherwise, or a near neighbour: s2 - sqrt(d2) with d1, d2
    // squares.
    Z s2 = random_bits(draw, 60), d2 = random_bits(draw, 1 + static_cast<int>(draw.below(120)));
    Z e1 = d1;
    if (draw.one_in(2)) {
      const Z root = random_bits(draw, 50), shift = random_bits(draw, 40);
      e1 = root * root;
      s2 = s1 + shift;
      d2 = (root + shift) * (root + shift) + static_cast<long>(draw.below(3)) - 1;
    }
    const Big difference = (big(s1) - sqrt(big(e1))) - (big(s2) - sqrt(big(d2)));
    const Big scale = big(s1) + big(s2) + 1;
    const int expected = abs(difference) < scale * Big("1e-300") ? 0 : (difference > 0 ? 1 : -1);
    equal += expected == 0;
    INFO(s1 << " - sqrt " << e1 << " and " << s2 << " - sqrt " << d2);
    REQUIRE(compare_entries(s1, e1, s2, d2) == expected);
    REQUIRE(compare_entries(s2, d2, s1, e1) == -expected);
  }
  CHECK(equal > 2600);  // 3 296 seen
}

TEST_CASE("A quadratic number compares with a binary64 exactly", "[oracle][quadratic]") {
  const Quadratic root_two{0, +1, 2, 1, 0};
  CHECK(compare(root_two, 1.4142135623730951) < 0);
  CHECK(compare(root_two, 1.414213562373095) > 0);
  CHECK(compare({3, +1, 0, 1, -2}, 0.75) == 0);
  CHECK(compare({3, +1, 0, 1, 5}, 96) == 0);
  CHECK(compare({1, -1, 0, 1, -1074}, 0) > 0);
  CHECK(compare(root_two, INFINITY) < 0);
}
