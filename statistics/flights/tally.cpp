#include "statistics/flights/tally.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "statistics/gpu/natural_log.hpp"

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

void FlightTally::count_hit(double t) {
  ++hits;
  time.add(t);
  square.add(std::min(t * t, std::numeric_limits<double>::max()));
  if (t > 0) {
    log.add(gpu::natural_log(t));
    ++logarithms;
  }
  shortest = std::min(shortest, t);
  longest = std::max(longest, t);
  bins.count(t);
}

void FlightTally::add(const FlightTally& other) {
  hits += other.hits, never += other.never, undecided += other.undecided, inside += other.inside;
  time.add(other.time), square.add(other.square), log.add(other.log);
  logarithms += other.logarithms;
  shortest = std::min(shortest, other.shortest);
  longest = std::max(longest, other.longest);
  bins.add(other.bins);
}

double FlightTally::mean() const {
  return time.value() / static_cast<double>(hits);
}

double FlightTally::standard_error() const {
  const auto n = static_cast<double>(hits);
  const double m = mean();
  if (hits < 2) return std::numeric_limits<double>::infinity();
  return std::sqrt(std::max(0.0, square.value() / n - m * m) / (n - 1));
}

double FlightTally::mean_log() const {
  return log.value() / static_cast<double>(logarithms);
}

}  // namespace lorentz::flights
