// A sum of binary64 numbers without rounding, so that it does not depend on their order.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace lorentz::flights {

/// The same to the bit however the numbers are split among threads, processes and machines, and whenever the
/// parts are added. (Kulisch's long accumulator: an integer in units of 2^-1074, in digits of 32 bits.)
class ExactSum {
 public:
  /// Of finite numbers.
  void add(double x);
  void add(const ExactSum& other);

  /// The nearest binary64; an infinity beyond them.
  double value() const;

  /// The number in units of 2^-1074, in hexadecimal, like -1f3; and back. Throws std::invalid_argument.
  std::string text() const;
  static ExactSum of(std::string_view text);

  bool operator==(const ExactSum& other) const;

 private:
  // 2098 bits for one number, and 62 for how many there are.
  static constexpr int kDigits = 68, kDigitBits = 32, kLowest = -1074;
  // So many numbers may be added before a digit that grows by less than 2^32 each time overflows.
  static constexpr std::uint32_t kMostPending = 1u << 30;

  void carry();
  ExactSum size(bool& negative) const;

  std::array<std::int64_t, kDigits> digits_{};
  std::uint32_t pending_ = 0;
};

}  // namespace lorentz::flights
