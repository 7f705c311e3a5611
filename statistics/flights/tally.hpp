// The statistics kept from many flights: counts, exact sums and histograms, in constant memory.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "statistics/flights/exact_sum.hpp"

namespace lorentz::flights {

/// Two histograms of times. Their edges are exact in binary64, so that counts are the same on every machine.
/// Logarithmic: eight bins per octave, with the edges 2^k (1 + j/8), from 2^-40 to
/// 2^60 units. Linear: 256 bins of 1/16 unit. The unit is a power of two, 2^exponent, near the mean free path
/// of a dilute gas of the same obstacles.
class Bins {
 public:
  static constexpr int kAnOctave = 8, kLowestOctave = -40, kHighestOctave = 60,
                       kLogarithmic = kAnOctave * (kHighestOctave - kLowestOctave), kLinear = 256,
                       kLinearInUnit = 16;

  explicit Bins(int exponent = 0);

  void count(double time) {
    ++logarithmic[log_index(time)];
    ++linear[linear_index(time)];
  }
  void add(const Bins& other);

  int exponent() const { return exponent_; }
  /// The lower edge of bin i, i = 0 .. kLogarithmic (kLinear).
  double log_edge(int i) const;
  double linear_edge(int i) const;

  /// The count below the first edge, the bins, and the count beyond the last edge.
  std::vector<std::uint64_t> logarithmic = std::vector<std::uint64_t>(kLogarithmic + 2);
  /// The bins, and the count beyond the last edge.
  std::vector<std::uint64_t> linear = std::vector<std::uint64_t>(kLinear + 1);

  bool operator==(const Bins&) const = default;

 private:
  // The exponent and the three highest bits of the fraction give the bin number of a positive number.
  static constexpr int kShift = 49;

  std::size_t log_index(double time) const {
    const std::int64_t i =
        static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(time) >> kShift) - first_ + 1;
    return i < 0 ? 0 : i > kLogarithmic + 1 ? kLogarithmic + 1 : static_cast<std::size_t>(i);
  }
  std::size_t linear_index(double time) const {
    const double i = time * per_bin_;
    return i < kLinear ? static_cast<std::size_t>(i) : kLinear;
  }

  int exponent_;
  std::int64_t first_;
  double per_bin_;
};

/// Tallies of disjoint sets of flights add up to the tally of their union, exact to the bit, in any order.
struct FlightTally {
  explicit FlightTally(int exponent = 0) : bins(exponent) {}

  std::uint64_t hits = 0, never = 0, undecided = 0;
  std::uint64_t inside = 0;      ///< starts that lay in an obstacle and were drawn again
  ExactSum time, square, log;    ///< of the times of hits, their rounded squares, their natural logs
  std::uint64_t logarithms = 0;  ///< summands of `log`; hits at t = 0 have none
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;  ///< times of hits
  Bins bins;

  std::uint64_t flights() const { return hits + never + undecided; }
  void count_hit(double time_of_hit);
  void add(const FlightTally& other);

  double mean() const;
  /// The standard error of the mean: the square root of (the mean of the squares minus the square of the
  /// mean) / (hits - 1). Infinite for fewer than two hits.
  double standard_error() const;
  double mean_log() const;

  bool operator==(const FlightTally&) const = default;
};

}  // namespace lorentz::flights
