#include "oracle/certificate/check/certificate_time.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string_view>

#include <lorentz/certificate.hpp>

namespace lorentz::oracle::certificate {

int sign_of(const Z& a, const Z& c, const Z& b) {
  if (a < 0 && a * a > c) return -1;  // a + sqrt(c) < 0 <= sqrt(b)
  // Here a + sqrt(c) >= 0, so the sign is that of (a + sqrt(c))^2 - b = p + 2 a sqrt(c).
  const Z p = a * a + c - b;
  const int first = sgn(p), second = sgn(a) * sgn(c);
  if (first == 0) return second;
  if (first == second) return first;
  return first * sgn(Z(p * p - 4 * a * a * c));  // the larger of the two decides
}

// Multiplied by q_a q_b: (q_b s_a - q_a s_b) + sqrt(q_a^2 d_b) - sqrt(q_b^2 d_a).
int compare(const ProofTime& a, const ProofTime& b) {
  return sign_of(b.q * a.s - a.q * b.s, a.q * a.q * b.d, b.q * b.q * a.d);
}

// Multiplied by q m: m (s -+ sqrt(d)) - n q.
int ProofTime::compare(const Z& n, const Z& m) const {
  const Z rest = m * s - n * q, root2 = m * m * d;
  return is_exit ? sign_of(rest, root2, 0) : sign_of(rest, 0, root2);
}

int ProofTime::compare_dyadic(const Z& n, long k) const {
  return compare(shifted_left(n, static_cast<unsigned long>(std::max(k, 0L))),
                 shifted_left(1, static_cast<unsigned long>(std::max(-k, 0L))));
}

namespace {

/// digits 10^exponent as written: all digits except leading zeros are significant.
struct Decimal {
  std::string digits;
  long exponent = 0;
};

/// Reads digits, an optional point with digits, and an optional e with a sign and up to four digits; nothing
/// else.
std::optional<Decimal> read_decimal(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789";
  if (text.size() > kLongestText) return std::nullopt;
  const auto take_digits = [&text, kDigits] {
    const std::string_view taken = text.substr(0, text.find_first_not_of(kDigits));
    text.remove_prefix(taken.size());
    return std::string(taken);
  };
  Decimal number{take_digits(), 0};
  if (number.digits.empty()) return std::nullopt;
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    const std::string fraction = take_digits();
    if (fraction.empty()) return std::nullopt;
    number.digits += fraction;
    number.exponent = -static_cast<long>(fraction.size());
  }
  if (text.starts_with('e')) {
    text.remove_prefix(1);
    const bool negative = text.starts_with('-');
    if (!negative && !text.starts_with('+')) return std::nullopt;
    text.remove_prefix(1);
    const std::string exponent = take_digits();
    if (exponent.empty() || exponent.size() > 4) return std::nullopt;
    number.exponent += (negative ? -1 : 1) * std::stol(exponent);
  }
  if (!text.empty()) return std::nullopt;
  number.digits.erase(0, number.digits.find_first_not_of('0'));
  return number;
}

}  // namespace

// A binary64 is m 2^e with e >= -1074, and 2^52 <= m < 2^53 if e > -1074. The times that round to it lie
// between the midpoints (2m +- 1) 2^(e-1) to its neighbours. Below m = 2^52 the neighbour, and so the
// midpoint, is twice as close, unless e = -1074. The midpoints belong to it iff m is even. An infinity reads
// as 2^52 2^972, the next number after the largest one, and it rounds accordingly: every time from its lower
// midpoint on belongs to it.
bool rounds_to(const ProofTime& exact, double given) {
  if (std::isnan(given) || std::signbit(given)) return false;
  const auto bits = std::bit_cast<std::uint64_t>(given);
  const long biased = static_cast<long>(bits >> 52), e = std::max(biased, 1L) - 1075;
  const long m = static_cast<long>(bits & ((1UL << 52) - 1)) + (biased > 0 ? 1L << 52 : 0);
  const int tie = m % 2 == 0 ? 0 : 1;
  const bool first_of_binade = m == 1L << 52 && biased > 1;
  const int low =
      first_of_binade ? exact.compare_dyadic(4 * m - 1, e - 2) : exact.compare_dyadic(2 * m - 1, e - 1);
  if (low < tie) return false;
  return std::isinf(given) || exact.compare_dyadic(2 * m + 1, e - 1) <= -tie;
}

// As above, with powers of ten. Below 100..0 the numbers of as many digits are ten times as close, and the
// last of them, 99..9, is odd.
bool rounds_to(const ProofTime& exact, const std::string& text) {
  if (text == "0") return exact.compare(0, 1) == 0;
  const std::optional<Decimal> given = read_decimal(text);
  if (!given || given->digits.empty()) return false;
  const Z m(given->digits, 10), up = power(10, static_cast<unsigned long>(std::max(given->exponent, 0L))),
                                down = power(10, static_cast<unsigned long>(std::max(-given->exponent, 0L)));
  const int tie = m % 2 == 0 ? 0 : 1;
  const bool first_of_decade = m == power(10, given->digits.size() - 1);
  const bool above_low = first_of_decade ? exact.compare((20 * m - 1) * up, 20 * down) >= 0
                                         : exact.compare((2 * m - 1) * up, 2 * down) >= tie;
  return above_low && exact.compare((2 * m + 1) * up, 2 * down) <= -tie;
}

}  // namespace lorentz::oracle::certificate
