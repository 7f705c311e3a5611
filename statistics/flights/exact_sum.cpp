#include "statistics/flights/exact_sum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace lorentz::flights {
namespace {

__extension__ using Wide = unsigned __int128;

}  // namespace

void ExactSum::add(double x) {
  if (x == 0) return;
  if (++pending_ > kMostPending) carry();
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int exponent = static_cast<int>(bits >> 52 & 0x7ff);
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
  // x is an integer below 2^53 in units of 2^(kLowest + place).
  const int place = exponent == 0 ? 0 : exponent - 1;
  const std::uint64_t integer = exponent == 0 ? fraction : fraction | std::uint64_t{1} << 52;
  const auto shifted = static_cast<Wide>(integer) << place % kDigitBits;
  std::int64_t* digit = &digits_[static_cast<std::size_t>(place / kDigitBits)];
  const std::int64_t sign = x < 0 ? -1 : 1;
  for (int k = 0; k < 3; ++k)
    digit[k] += sign * static_cast<std::int64_t>(static_cast<std::uint32_t>(shifted >> kDigitBits * k));
}

void ExactSum::add(const ExactSum& other) {
  carry();  // now digits are below 2^32, and the other's below 2^62
  for (std::size_t i = 0; i < kDigits; ++i) digits_[i] += other.digits_[i];
  carry();
}

// Brings all digits into [0, 2^32), except the highest, which has the sign.
void ExactSum::carry() {
  for (std::size_t i = 0; i + 1 < kDigits; ++i) {
    const std::int64_t over = digits_[i] >> kDigitBits;
    digits_[i] -= over * (std::int64_t{1} << kDigitBits);
    digits_[i + 1] += over;
  }
  pending_ = 1;  // the carried digits count as one number
}

// The absolute value, with carried digits, and the sign.
ExactSum ExactSum::size(bool& negative) const {
  ExactSum sum = *this;
  sum.carry();
  negative = sum.digits_.back() < 0;
  if (negative) {
    for (std::int64_t& digit : sum.digits_) digit = -digit;
    sum.carry();
  }
  return sum;
}

double ExactSum::value() const {
  bool negative = false;
  const ExactSum sum = size(negative);
  int top = kDigits - 1;
  while (top > 0 && sum.digits_[static_cast<std::size_t>(top)] == 0) --top;
  // The four highest digits have at least 97 bits. Lower digits only break ties.
  Wide head = 0;
  for (int i = top; i > top - 4; --i)
    head =
        head << kDigitBits | static_cast<std::uint32_t>(i < 0 ? 0 : sum.digits_[static_cast<std::size_t>(i)]);
  for (int i = 0; i <= top - 4; ++i)
    if (sum.digits_[static_cast<std::size_t>(i)] != 0) head |= 1;
  // Round to the 53 bits of the result, or to fewer if it is subnormal, so that the scaling does not round.
  const int place = kDigitBits * (top - 3) + kLowest;
  int bits = 0;
  for (Wide rest = head; rest != 0; rest >>= 1) ++bits;
  const int drop = std::max({0, bits - 53, kLowest - place});
  if (drop > 0 && drop < 128) {
    const Wide half = static_cast<Wide>(1) << (drop - 1), rest = head & ((half << 1) - 1);
    head >>= drop;
    if (rest > half || (rest == half && (head & 1) != 0)) ++head;
  }
  const double rounded = std::ldexp(static_cast<double>(head), place + drop);
  return negative ? -rounded : rounded;
}

std::string ExactSum::text() const {
  bool negative = false;
  const ExactSum sum = size(negative);
  static constexpr char kHex[] = "0123456789abcdef";
  std::string text;
  for (std::size_t i = kDigits; i-- > 0;)
    for (int shift = kDigitBits - 4; shift >= 0; shift -= 4) {
      const char c = kHex[sum.digits_[i] >> shift & 15];
      if (!text.empty() || c != '0') text += c;
    }
  if (text.empty()) return "0";
  return negative ? '-' + text : text;
}

ExactSum ExactSum::of(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  // The highest digit may be half full.
  if (text.empty() || text.size() >= std::size_t{kDigits} * kDigitBits / 4)
    throw std::invalid_argument("not a sum: too many hexadecimal digits");
  ExactSum sum;
  int place = 0;
  for (auto c = text.rbegin(); c != text.rend(); ++c, place += 4) {
    const bool decimal = *c >= '0' && *c <= '9';
    if (!decimal && !(*c >= 'a' && *c <= 'f')) throw std::invalid_argument("no sum: not hexadecimal");
    const std::int64_t value = decimal ? *c - '0' : *c - 'a' + 10;
    sum.digits_[static_cast<std::size_t>(place / kDigitBits)] += value << place % kDigitBits;
  }
  if (negative)
    for (std::int64_t& digit : sum.digits_) digit = -digit;
  sum.carry();
  return sum;
}

bool ExactSum::operator==(const ExactSum& other) const {
  ExactSum a = *this, b = other;
  a.carry(), b.carry();
  return a.digits_ == b.digits_;
}

}  // namespace lorentz::flights
