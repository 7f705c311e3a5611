// What is kept of many flights: counts, exact sums and histograms, in constant memory.
#pragma once

#include <cstdint>
#include <limits>

#include "statistics/flights/bins.hpp"
#include "statistics/flights/exact_sum.hpp"

namespace lorentz::flights {

/// Tallies of disjoint sets of flights add up to that of their union, to the bit, in any order.
struct FlightTally {
  explicit FlightTally(int exponent = 0) : bins(exponent) {}

  std::uint64_t hits = 0, never = 0, undecided = 0;
  std::uint64_t inside = 0;      ///< starts that lay in an obstacle, and were drawn anew
  ExactSum time, square, log;    ///< of the times of hits; of their rounded squares and natural logarithms
  std::uint64_t logarithms = 0;  ///< of hits at t = 0 there is none
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;  ///< times of hits
  Bins bins;

  std::uint64_t flights() const { return hits + never + undecided; }
  void count_hit(double time_of_hit);
  void add(const FlightTally& other);

  double mean() const;
  /// Of the mean: the root of (the mean of the squares less the square of the mean) / (hits - 1); infinite of
  /// fewer than two hits.
  double standard_error() const;
  double mean_log() const;

  bool operator==(const FlightTally&) const = default;
};

}  // namespace lorentz::flights
