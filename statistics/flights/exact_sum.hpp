// A sum of binary64 numbers without rounding. It does not depend on their order.
#pragma once

#include <array>
#include <cstdint>
#include <tuple>

namespace lorentz::flights {

/// The sum is the same to the bit however the numbers are split among threads, processes and machines, and
/// whenever the parts are added. (Kulisch's long accumulator: an integer in units of 2^-1074, in digits of 32
/// bits.)
class ExactSum {
 public:
  /// x must be finite.
  void add(double x);
  void add(const ExactSum& other);

  /// Digits of 32 bits in units of 2^-1074, lowest first, below 2^62 each and of either sign.
  using Digits = std::array<std::int64_t, 68>;
  void add(const Digits& digits);

  /// The nearest binary64 number; an infinity if the sum is out of range.
  double value() const;

  bool operator==(const ExactSum& other) const;
  friend auto members_of(ExactSum& self) {  // the same for the same sum
    self.carry();
    return std::tie(self.digits_);
  }

 private:
  // 2098 bits for one number, and 62 for the number of summands.
  static constexpr int kDigits = std::tuple_size_v<Digits>, kDigitBits = 32, kLowest = -1074;
  // The number of summands before a digit can overflow; each summand adds less than 2^32 to a digit.
  static constexpr std::uint32_t kMostPending = 1u << 30;

  void carry();
  ExactSum size(bool& negative) const;

  Digits digits_{};
  std::uint32_t pending_ = 0;
};

}  // namespace lorentz::flights
