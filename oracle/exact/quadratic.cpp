#include "oracle/exact/quadratic.hpp"

#include <cmath>
#include <limits>

#include "oracle/integers/dyadic.hpp"

namespace lorentz::oracle {

int sign_of(const Z& a, int sign, const Z& d) {
  if (sgn(a) * sign >= 0) return sgn(a) != 0 ? sgn(a) : (d != 0 ? sign : 0);
  // a and the root pull in opposite directions: the larger square wins.
  const int larger = cmp(Z(a * a), d);
  return larger > 0 ? sgn(a) : (larger < 0 ? sign : 0);
}

int compare_entries(const Z& s1, const Z& d1, const Z& s2, const Z& d2) {
  const Z lead = s1 - s2;
  if (lead < 0) return -compare_entries(s2, d2, s1, d1);
  // Sign of lead + sqrt(d2) - sqrt(d1) with lead >= 0. Both sides of lead + sqrt(d2) ? sqrt(d1) are >= 0, so
  // compare their squares: 2 lead sqrt(d2) ? d1 - d2 - lead^2 =: excess. If excess >= 0, square once more.
  const Z excess = d1 - d2 - lead * lead;
  if (excess < 0) return 1;
  return cmp(Z(4 * lead * lead * d2), Z(excess * excess));
}

int compare_entries(const Z& s1, const Z& d1, const Z& q1, const Z& s2, const Z& d2, const Z& q2) {
  if (q1 == q2) return compare_entries(s1, d1, s2, d2);
  return compare_entries(s1 * q2, d1 * q2 * q2, s2 * q1, d2 * q1 * q1);
}

int compare(const Quadratic& number, double value) {
  if (std::isinf(value)) return value > 0 ? -1 : 1;
  // number - m 2^e has the sign of (a - m q 2^(e - exponent)) + sign sqrt(d), which is scaled to integers.
  const Dyadic dyadic(value);
  const long shift = dyadic.exponent - number.exponent;
  if (shift >= 0)
    return sign_of(number.a - shifted_left(dyadic.mantissa * number.q, shift), number.sign, number.d);
  return sign_of(shifted_left(number.a, -shift) - dyadic.mantissa * number.q, number.sign,
                 shifted_left(number.d, -2 * shift));
}

namespace {

// floor(number * factor) for a number > 0, and whether it is exact.
struct Floor {
  Z value;
  bool exact = false;
};

Floor floor_of(const Quadratic& n, const Z& factor, long binary_shift) {
  Z a = n.a, d = n.d, q = n.q;
  if (factor != 1) {
    a *= factor;
    d *= factor * factor;
  }
  const long shift = n.exponent + binary_shift;
  if (shift >= 0) {
    a = shifted_left(a, shift);
    d = shifted_left(d, 2 * shift);
  } else {
    q = shifted_left(q, -shift);
  }
  const auto [root, square] = square_root(d);
  auto [value, whole] = divide(n.sign > 0 ? a + root : a - root - (square ? 0 : 1), q, Z::Rounding::down);
  return {std::move(value), square && whole};
}

// An e with 2^(e-3) < number < 2^(e+3), for a number > 0. If a and the root have opposite signs, their sum is
// computed as (a^2 - d) / (|a| + sqrt(d)), which does not cancel.
long binary_magnitude(const Quadratic& n) {
  const long bits_a = bit_length(n.a), bits_root = (bit_length(n.d) + 1) / 2;
  const long bits_sum = std::max(bits_a, bits_root);
  long bits = bits_sum;
  if (sgn(n.a) * n.sign < 0 && n.d != 0) bits = bit_length(n.a * n.a - n.d) - bits_sum;
  return bits - bit_length(n.q) + n.exponent;
}

Quadratic negated(Quadratic n) {
  n.a = -n.a;
  n.sign = -n.sign;
  return n;
}

// The integer nearest to y, ties to even, given `twice` = floor(2 y).
Z round_half_even(const Floor& twice) {
  Z value = twice.value / 2;
  const bool half = is_odd(twice.value);
  if (half && (!twice.exact || is_odd(value))) ++value;
  return value;
}

}  // namespace

namespace {

// floor(number / 2^bits).
Floor cut(const Floor& whole, long bits) {
  return {whole.value >> static_cast<unsigned long>(bits),
          whole.exact && (whole.value == 0 || trailing_zeros(whole.value) >= bits)};
}

// The nearest binary64 to a number > 0. `floor_at` maps p to floor(number / 2^p) and whether that is exact;
// `magnitude` is a guess of the exponent that is off by at most a few bits.
template <class FloorAt>
double rounded(long magnitude, FloorAt floor_at) {
  // The unit in the last place is 2^p; the floor corrects the guess.
  constexpr long kSmallest = -1074;
  long p = std::max(magnitude - 60, kSmallest - 1);
  const Floor fine = floor_at(p);
  const long at = p, bits = bit_length(fine.value);
  p = std::max(p + bits - 53, kSmallest);
  const Z mantissa = round_half_even(p - 1 >= at ? cut(fine, p - 1 - at) : floor_at(p - 1));
  if (bit_length(mantissa) + p > 1024) return std::numeric_limits<double>::infinity();
  return std::ldexp(mantissa.get_d(), static_cast<int>(p));  // mantissa <= 2^53: both steps are exact
}

// floor(sqrt(y)) = floor(sqrt(floor(y))).
Floor root_of(const Floor& square) {
  auto [root, whole] = square_root(square.value);
  return {std::move(root), square.exact && whole};
}

}  // namespace

double round_to_binary64(const Quadratic& n) {
  const int sign = sign_of(n.a, n.sign, n.d);
  if (sign == 0) return 0.0;
  if (sign < 0) return -round_to_binary64(negated(n));
  return rounded(binary_magnitude(n), [&](long p) { return floor_of(n, 1, -p); });
}

double round_root_to_binary64(const Quadratic& square, int sign) {
  if (sign_of(square.a, square.sign, square.d) == 0) return 0.0;
  const double root =
      rounded(binary_magnitude(square) / 2, [&](long p) { return root_of(floor_of(square, 1, -2 * p)); });
  return sign * root;
}

namespace {

Z power_of_ten(long exponent) {
  return power(10, static_cast<unsigned long>(exponent));
}

// number * 10^exponent.
Quadratic times_power_of_ten(Quadratic n, long exponent) {
  const Z power = power_of_ten(std::labs(exponent));
  if (exponent < 0) {
    n.q *= power;
  } else {
    n.a *= power;
    n.d *= power * power;
  }
  return n;
}

std::string with_point(const std::string& digits, long exponent10) {
  const long count = static_cast<long>(digits.size());
  if (exponent10 < -7 || exponent10 >= count) {
    std::string mantissa = digits.substr(0, 1) + (count > 1 ? "." + digits.substr(1) : "");
    return mantissa + (exponent10 < 0 ? "e-" : "e+") + std::to_string(std::labs(exponent10));
  }
  if (exponent10 < 0) return "0." + std::string(-exponent10 - 1, '0') + digits;
  if (exponent10 + 1 == count) return digits;
  return digits.substr(0, exponent10 + 1) + "." + digits.substr(exponent10 + 1);
}

}  // namespace

std::string round_to_decimal(const Quadratic& n, int digits) {
  const int sign = sign_of(n.a, n.sign, n.d);
  if (sign == 0) return "0";
  if (sign < 0) return "-" + round_to_decimal(negated(n), digits);
  // 10^exponent10 <= number < 10^(exponent10 + 1): guessed from the bits, then corrected by the floor.
  long exponent10 =
      static_cast<long>(std::floor(static_cast<double>(binary_magnitude(n)) * 0.30102999566398120));
  const Z least = power_of_ten(digits - 1), limit = power_of_ten(digits);
  for (;;) {
    const Z value = floor_of(times_power_of_ten(n, digits - 1 - exponent10), 1, 0).value;
    if (value >= limit)
      ++exponent10;
    else if (value < least)
      --exponent10;
    else
      break;
  }
  Z value = round_half_even(floor_of(times_power_of_ten(n, digits - 1 - exponent10), 2, 0));
  if (value == limit) {
    value = least;
    ++exponent10;
  }
  return with_point(value.get_str(), exponent10);
}

}  // namespace lorentz::oracle
