// The statistics kept from many flights: counts, exact sums and histograms, in constant memory.
#pragma once

#include <cstdint>
#include <limits>

#include "statistics/flights/bins.hpp"
#include "statistics/flights/exact_sum.hpp"

namespace lorentz::flights {

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
