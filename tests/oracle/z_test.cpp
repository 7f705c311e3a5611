// The oracle's integers against GMP's own, mpz_class: drawn operands of 0 to 26 limbs, many of them next to a
// power of 2^64, so that all that can happen at the border between numbers in place and numbers on the heap
// does happen.
#include "oracle/integers/z.hpp"

#include <gmpxx.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "oracle/integers/integer.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::oracle;
using test::Draw;

namespace {

constexpr int kMostLimbs = 26;

mpz_class power_of_two(unsigned long exponent) {
  mpz_class power;
  mpz_ui_pow_ui(power.get_mpz_t(), 2, exponent);
  return power;
}

// Random limbs; of runs of ones and zeros; near a power of two, most often of 2^64; a small number.
mpz_class drawn_size(Draw& draw) {
  const unsigned long bits = draw.below(64 * kMostLimbs);
  switch (draw.below(5)) {
    case 0:
      return draw.below(4);
    case 1: {
      const unsigned long exponent = draw.one_in(4)   ? bits
                                     : draw.one_in(4) ? 63
                                                      : 64 * draw.below(kMostLimbs);
      return abs(power_of_two(exponent) + static_cast<long>(draw.below(5)) - 2);
    }
    case 2: {
      mpz_class a = 0;
      for (unsigned long i = 0; i < bits; i += 64) {
        const unsigned long limb = draw.one_in(3) ? draw.below(~0ul) : draw.one_in(2) ? 0 : ~0ul;
        a = (a << 64) + limb;
      }
      return a;
    }
    default: {
      mpz_class a = 1;
      while (mpz_sizeinbase(a.get_mpz_t(), 2) <= bits) a = (a << 64) + draw.below(~0ul);
      return a >> (mpz_sizeinbase(a.get_mpz_t(), 2) - bits);
    }
  }
}

mpz_class drawn(Draw& draw) {
  return draw.one_in(2) ? drawn_size(draw) : mpz_class(-drawn_size(draw));
}

Z z_of(const mpz_class& a) {
  return Z(a.get_mpz_t());
}

bool same(const Z& a, const mpz_class& b) {
  const Z::LimbView view(a);
  return mpz_cmp(view, b.get_mpz_t()) == 0 && mpz_size(view) == mpz_size(b.get_mpz_t());
}

int sign(int order) {
  return order < 0 ? -1 : order > 0;
}

mpz_class floor_of(const mpz_class& a, const mpz_class& b) {
  mpz_class q;
  mpz_fdiv_q(q.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  return q;
}

mpz_class ceiling_of(const mpz_class& a, const mpz_class& b) {
  mpz_class q;
  mpz_cdiv_q(q.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  return q;
}

}  // namespace

TEST_CASE("Z: sums, products, quotients and orders are those of mpz_class", "[oracle][integers]") {
  Draw draw(71);
  INFO("seed 71");
  int zero = 0, exact = 0, equal = 0;
  std::map<int, int> limbs;
  for (int i = 0; i < 200000; ++i) {
    const mpz_class a = drawn(draw);
    // Often a multiple or a neighbour, which cancel.
    const mpz_class b = draw.one_in(8)   ? mpz_class(a + static_cast<long>(draw.below(3)) - 1)
                        : draw.one_in(8) ? mpz_class(-a)
                                         : drawn(draw);
    // Often a multiple of b or beside one, with a quotient of few bits or many.
    const mpz_class times = draw.one_in(2) ? a : mpz_class(draw.below(1ull << draw.below(55)));
    const mpz_class c = draw.one_in(3)   ? mpz_class(times * b)
                        : draw.one_in(2) ? mpz_class(times * b + static_cast<long>(draw.below(3)) - 1)
                                         : drawn(draw);
    const Z x = z_of(a), y = z_of(b), w = z_of(c);
    ++limbs[static_cast<int>(mpz_size(a.get_mpz_t()))];
    INFO("a " << a << " b " << b << " c " << c);
    REQUIRE(same(x, a));
    REQUIRE(same(x + y, a + b));
    REQUIRE(same(x - y, a - b));
    REQUIRE(same(-x, -a));
    REQUIRE(same(abs(x), abs(a)));
    REQUIRE(same(x * y, a * b));
    REQUIRE(sgn(x) == sgn(a));
    REQUIRE(sign(cmp(x, y)) == sign(cmp(a, b)));
    REQUIRE((x == y) == (a == b));
    REQUIRE((x < y) == (a < b));
    REQUIRE((x >= y) == (a >= b));
    Z sum = w;
    REQUIRE(same(sum.add_product(x, y), c + a * b));
    REQUIRE(same(sum.subtract_product(y, x), c));
    REQUIRE(same(sum.subtract_product(x, w), c - a * c));
    REQUIRE(same(minor_of(x, y, w, x), a * a - b * c));
    equal += a == b;
    if (b == 0) {
      ++zero;
      REQUIRE_THROWS_AS(floor_div(x, y), std::domain_error);
      REQUIRE_THROWS_AS(x / y, std::domain_error);
      continue;
    }
    REQUIRE(same(w / y, c / b));
    REQUIRE(same(w % y, c % b));
    REQUIRE(same(floor_div(w, y), floor_of(c, b)));
    REQUIRE(same(ceil_div(w, y), ceiling_of(c, b)));
    REQUIRE(divide(w, y, Z::Rounding::down).exact == (c % b == 0));
    if (b > 0) REQUIRE(same(round_div(w, y), floor_of(2 * c + b, 2 * b)));
    exact += c % b == 0;
  }
  CHECK(zero > 5000);
  CHECK(exact > 20000);
  CHECK(equal > 5000);
  for (int n = 0; n <= kMostLimbs; ++n) CHECK(limbs[n] > 500);
}

TEST_CASE("Z: one number may stand in several places of an operation", "[oracle][integers]") {
  Draw draw(72);
  INFO("seed 72");
  for (int i = 0; i < 50000; ++i) {
    const mpz_class a = drawn(draw), b = drawn(draw);
    const Z x = z_of(a), y = z_of(b);
    INFO("a " << a << " b " << b);
    const auto changed = [&](const auto& change) {
      Z z = x;
      change(z);
      return z;
    };
    REQUIRE(same(changed([](Z& z) { z += z; }), a + a));
    REQUIRE(same(changed([](Z& z) { z -= z; }), 0));
    REQUIRE(same(changed([](Z& z) { z *= z; }), a * a));
    REQUIRE(same(changed([](Z& z) { z = z * z; }), a * a));
    REQUIRE(same(changed([](Z& z) { z = z + z; }), a + a));
    REQUIRE(same(changed([](Z& z) { z = -z; }), -a));
    REQUIRE(same(changed([](Z& z) { z = z >> 1; }), a >> 1));
    REQUIRE(same(changed([](Z& z) { z.add_product(z, z); }), a + a * a));
    REQUIRE(same(changed([](Z& z) { z.subtract_product(z, z); }), a - a * a));
    REQUIRE(same(changed([&](Z& z) { z.add_product(z, y); }), a + a * b));
    REQUIRE(same(changed([&](Z& z) { z.add_product(y, z); }), a + a * b));
    REQUIRE(same(changed([&](Z& z) { z += y; }), a + b));
    REQUIRE(same(changed([&](Z& z) { z -= y; }), a - b));
    REQUIRE(same(changed([&](Z& z) { z *= y; }), a * b));
    REQUIRE(same(changed([](Z& z) { ++z; }), a + 1));
    REQUIRE(same(changed([](Z& z) { --z; }), a - 1));
    if (a != 0) REQUIRE(same(changed([](Z& z) { z /= z; }), 1));
  }
}

TEST_CASE("Z: copies and moves, whatever was there before", "[oracle][integers]") {
  Draw draw(73);
  INFO("seed 73");
  for (int i = 0; i < 50000; ++i) {
    const mpz_class a = drawn(draw), b = drawn(draw), c = drawn(draw);
    INFO("a " << a << " b " << b << " c " << c);
    Z x = z_of(a), y = z_of(b);
    const Z &same_x = x, copy(x);
    x = same_x;
    REQUIRE(same(x, a));
    Z& alias = x;
    x = std::move(alias);
    REQUIRE(same(x, a));
    std::swap(x, y);
    REQUIRE(same(x, b));
    REQUIRE(same(y, a));
    x = y;
    REQUIRE(same(x, a));
    REQUIRE(same(y, a));
    Z moved(std::move(x));
    REQUIRE(same(moved, a));
    x = z_of(c);  // what was moved from is a number again
    REQUIRE(same(x, c));
    x = std::move(moved);
    REQUIRE(same(x, a));
    moved = z_of(b);
    x = std::move(moved);
    moved = copy;
    REQUIRE(same(x, b));
    REQUIRE(same(moved, a));
    // A number on the heap keeps its room when it becomes small, and what it is given then.
    x = 7;
    REQUIRE(same(x, 7));
    Z small(std::move(x));
    small += z_of(c);
    REQUIRE(same(small, c + 7));
  }
  std::vector<Z> many;
  for (int i = 0; i < 300; ++i) many.push_back(Z(1) << static_cast<unsigned long>(5 * i));
  for (int i = 0; i < 300; ++i) CHECK(same(many[i], power_of_two(5 * i)));
}

TEST_CASE("Z: bits, roots, divisors and digits are those of GMP", "[oracle][integers]") {
  Draw draw(74);
  INFO("seed 74");
  int squares = 0;
  for (int i = 0; i < 50000; ++i) {
    const mpz_class a = drawn(draw), b = drawn(draw);
    const Z x = z_of(a), y = z_of(b);
    const unsigned long bits = draw.one_in(3) ? 64 * draw.below(30) : draw.below(2000);
    INFO("a " << a << " b " << b << " bits " << bits);
    REQUIRE(same(shifted_left(x, bits), a << bits));
    REQUIRE(same(x << bits, a << bits));
    REQUIRE(same(x >> bits, a >> bits));
    REQUIRE(bit_length(x) == (a == 0 ? 0 : static_cast<long>(mpz_sizeinbase(a.get_mpz_t(), 2))));
    REQUIRE(is_odd(x) == (mpz_odd_p(a.get_mpz_t()) != 0));
    if (a != 0) REQUIRE(trailing_zeros(x) == static_cast<long>(mpz_scan1(a.get_mpz_t(), 0)));
    REQUIRE(x.get_str() == a.get_str());
    REQUIRE(x.get_str(16) == a.get_str(16));
    REQUIRE(same(Z(a.get_str()), a));
    REQUIRE(same(Z(a.get_str(16), 16), a));
    REQUIRE(x.fits_slong_p() == a.fits_slong_p());
    if (a.fits_slong_p()) REQUIRE(x.get_si() == a.get_si());
    REQUIRE(x.get_d() == a.get_d());
    const BinaryApproximation near = approximation(x);
    long exponent = 0;
    REQUIRE(near.mantissa == mpz_get_d_2exp(&exponent, a.get_mpz_t()));
    REQUIRE(near.exponent == exponent);
    REQUIRE(x.get_ui() == a.get_ui());
    if (std::isfinite(a.get_d())) REQUIRE(same(Z(a.get_d()), mpz_class(a.get_d())));
    REQUIRE(same(gcd(x, y), gcd(a, b)));
    REQUIRE(same(lcm(x, y), lcm(a, b)));
    const Bezout one = bezout(x, y);
    REQUIRE(one.gcd == gcd(x, y));
    REQUIRE(one.x * x + one.y * y == one.gcd);

    const mpz_class square = draw.one_in(2) ? mpz_class(a * a) : mpz_class(abs(a));
    const Z::Root root = square_root(z_of(square));
    REQUIRE(same(root.floor, sqrt(square)));
    REQUIRE(root.exact == (sqrt(square) * sqrt(square) == square));
    REQUIRE(same(ceil_sqrt(z_of(square)), root.exact ? sqrt(square) : mpz_class(sqrt(square) + 1)));
    if (a < 0) REQUIRE_THROWS_AS(square_root(x), std::domain_error);
    squares += root.exact;
  }
  CHECK(squares > 20000);
  CHECK_THROWS_AS(Z("12x"), std::invalid_argument);
  CHECK_THROWS_AS(Z(""), std::invalid_argument);
}

TEST_CASE("Z: built-in integers of every size come in exactly", "[oracle][integers]") {
  constexpr auto kLeast = std::numeric_limits<std::int64_t>::min(),
                 kMost = std::numeric_limits<std::int64_t>::max();
  constexpr auto kMostUnsigned = std::numeric_limits<std::uint64_t>::max();
  CHECK(Z().get_str() == "0");
  CHECK(Z(0).get_str() == "0");
  CHECK(Z(-1).get_str() == "-1");
  CHECK(Z(kLeast).get_str() == "-9223372036854775808");
  CHECK(Z(kMost).get_str() == "9223372036854775807");
  CHECK(Z(kMostUnsigned).get_str() == "18446744073709551615");
  CHECK(Z(kLeast) == kLeast);
  CHECK(Z(kMostUnsigned) == kMostUnsigned);
  CHECK(Z(kMostUnsigned) + 1 > kMostUnsigned);
  CHECK(Z(kLeast) - 1 < kLeast);
  CHECK(Z(kLeast).fits_slong_p());
  CHECK_FALSE((Z(kLeast) - 1).fits_slong_p());
  CHECK_FALSE(Z(kMostUnsigned).fits_slong_p());
  CHECK(0 > Z(-3));
  CHECK(Z(-3) != 3);
  CHECK(power(10, 30).get_str() == "1" + std::string(30, '0'));
}
