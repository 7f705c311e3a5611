// A sum of binary64 numbers without rounding. It does not depend on their order.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace lorentz::flights {

/// The sum is the same to the bit however the numbers are split among threads, processes and machines, and
/// whenever the parts are added. (Kulisch's long accumulator: an integer in units of 2^-1074, in digits of 32
/// bits.)
class ExactSum {
 public:
  /// x must be finite.
  void add(double x);
  void add(const ExactSum& other);

  /// The nearest binary64 number; an infinity if the sum is out of range.
  double value() const;

  /// The sum in units of 2^-1074, in hexadecimal, such as -1f3, and the inverse. `of` throws
  /// std::invalid_argument.
  std::string text() const;
  static ExactSum of(std::string_view text);

  bool operator==(const ExactSum& other) const;

 private:
  // 2098 bits for one number, and 62 for the number of summands.
  static constexpr int kDigits = 68, kDigitBits = 32, kLowest = -1074;
  // The number of summands before a digit can overflow; each summand adds less than 2^32 to a digit.
  static constexpr std::uint32_t kMostPending = 1u << 30;

  void carry();
  ExactSum size(bool& negative) const;

  std::array<std::int64_t, kDigits> digits_{};
  std::uint32_t pending_ = 0;
};

}  // namespace lorentz::flights
