// A hash of 64 bits that shows whether two computers computed the same numbers.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <ostream>

#include <lorentz/vec.hpp>

namespace lorentz::fitness {

/// A hash of numbers in their order. If a stream is given, the hash also writes the numbers to it, one per
/// line, so that the numbers of two computers can be compared one by one.
class Hash {
 public:
  explicit Hash(std::ostream* trace = nullptr) : trace_(trace) {}

  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x9e3779b97f4a7c15;
    value_ ^= value_ >> 32;
    if (trace_) *trace_ << std::hex << word << '\n';
  }
  void add(std::int64_t number) { add(static_cast<std::uint64_t>(number)); }
  void add(int number) { add(static_cast<std::int64_t>(number)); }

  /// All NaNs count as the same, because processors give them different bits.
  void add(double number) {
    add(std::isnan(number) ? ~std::uint64_t{0} : std::bit_cast<std::uint64_t>(number));
  }
  void add(const Vec& vector) {
    for (const double component : vector) add(component);
  }

  std::uint64_t value() const { return value_; }

 private:
  std::ostream* trace_;
  std::uint64_t value_ = 0;
};

}  // namespace lorentz::fitness
