// Counts how many of an engine's answers are right, wrong, .., and keeps how exact their times are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "question/counts.hpp"

namespace lorentz::question {

/// The value that this share of the values does not exceed; 0 if there are no values.
double quantile(std::vector<double> values, double share);

/// How long an engine takes.
struct Speed {
  double ns_per_query = 0;  ///< mean over the queries, in the median round; 0: not timed
  double ns_median = 0;  ///< median of the means of blocks of 16 queries (1024 for a batch engine, 256 for a
                         ///< library); for a command, whose answers come at irregular times, the mean
  double ns_low = 0, ns_high = 0;           ///< the quartiles of these means
  std::optional<double> processor_ns = {};  ///< ns_per_query in processor time, if known
  std::optional<double> own_ns = {};        ///< per query, in the engine's own calls, as it reports (OwnTime)
  bool failed = false;                      ///< an external engine that broke on the way
};

/// What one engine did over some questions.
struct Tally {
  std::string name;
  std::size_t queries = 0;
  Counts counts;
  std::vector<double> ulps;  ///< errors of the times of right obstacles, as far as they could be measured
  std::vector<double> wrong_ulps, wrong_conditions;  ///< errors of wrong times: in ulps, in units of the
                                                     ///< condition
  Speed speed;

  std::size_t operator[](Count count) const { return counts[count]; }
  void count(const oracle::Judgement& judgement);
  void add(const Tally& other);  ///< adds counts and errors, but not name and speed
  double mean_ulp() const;       ///< 0 without errors, like max_ulp()
  double max_ulp() const;
};

}  // namespace lorentz::question
