// Do standard errors hold as often as they say? Estimates of many seeds, held against the mean of all.
#pragma once

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "statistics/chaos/groups.hpp"

namespace lorentz::test {

inline constexpr std::uint64_t kCoverageSeeds = 400;  ///< 1, 2, ..

/// With 64 groups, 94.6 % of estimates lie within 1.96 errors of the truth: 378 +- 4.5 of 400 seeds, here
/// within 4 deviations.
inline void check_coverage(const std::string& name, const std::vector<chaos::Estimate>& estimates) {
  const auto n = static_cast<double>(estimates.size());
  double mean = 0;
  int held = 0;
  for (const chaos::Estimate& one : estimates) mean += one.value / n;
  for (const chaos::Estimate& one : estimates) held += std::fabs(one.value - mean) < 1.96 * one.error;
  fmt::print("{}: {} of {} hold {:.6g}\n", name, held, n, mean);
  INFO(name);
  CHECK(std::fabs(held - 0.946 * n) < 4 * std::sqrt(0.946 * 0.054 * n));
}

}  // namespace lorentz::test
