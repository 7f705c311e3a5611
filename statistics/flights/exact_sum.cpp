#include "statistics/flights/exact_sum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

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
  add(other.digits_);  // they are below 2^62
}

void ExactSum::add(const Digits& digits) {
  carry();  // now its own are below 2^32
  for (std::size_t i = 0; i < kDigits; ++i) digits_[i] += digits[i];
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
  std::size_t low = kDigits - 4;  // of the four highest digits, which have at least 97 bits
  while (low > 0 && sum.digits_[low + 3] == 0) --low;
  Wide head = 0;
  for (std::size_t i = low + 4; i-- > low;) head = head << kDigitBits | static_cast<Wide>(sum.digits_[i]);
  // Lower digits only break ties.
  if (std::any_of(&sum.digits_[0], &sum.digits_[low], [](std::int64_t digit) { return digit != 0; }))
    head |= 1;
  // The conversion rounds, to nearest. The scaling does not: a sum is a multiple of 2^-1074, so that one
  // below the normal numbers has fewer than 53 bits.
  const double rounded = std::ldexp(static_cast<double>(head), kDigitBits * static_cast<int>(low) + kLowest);
  return negative ? -rounded : rounded;
}

bool ExactSum::operator==(const ExactSum& other) const {
  ExactSum a = *this, b = other;
  a.carry(), b.carry();
  return a.digits_ == b.digits_;
}

}  // namespace lorentz::flights
