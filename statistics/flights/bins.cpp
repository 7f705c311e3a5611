#include "statistics/flights/bins.hpp"

#include <cmath>
#include <stdexcept>

namespace lorentz::flights {

Bins::Bins(int exponent)
    : exponent_(exponent),
      first_(static_cast<std::int64_t>(
          std::bit_cast<std::uint64_t>(std::ldexp(1.0, exponent + kLowestOctave)) >> kShift)),
      per_bin_(std::ldexp(kLinearInUnit, -exponent)) {}

void Bins::add(const Bins& other) {
  if (other.exponent_ != exponent_) throw std::invalid_argument("histograms with other bins");
  for (std::size_t i = 0; i < logarithmic.size(); ++i) logarithmic[i] += other.logarithmic[i];
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] += other.linear[i];
}

double Bins::log_edge(int i) const {
  return std::bit_cast<double>(static_cast<std::uint64_t>(first_ + i) << kShift);
}

double Bins::linear_edge(int i) const {
  return i / per_bin_;
}

}  // namespace lorentz::flights
