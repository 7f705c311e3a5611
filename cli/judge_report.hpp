// Private to cli/judge*.cpp: what `lorentz judge` says in the end.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/judge_paths.hpp"
#include "judge/examination.hpp"

namespace lorentz::cli {

struct JudgeReport {
  std::string engine;
  std::uint64_t seed = 0;
  std::string command;  ///< the shell line that was typed
  std::vector<judge::Row> rows;
  std::vector<judge::Finding> findings;
  judge::Calls calls;
  std::vector<FlownScene> flown;
  double timeout = 0;   ///< seconds of silence that are a failure of another program
  double start_up = 0;  ///< seconds that another program took to start
  std::optional<double> ns_per_query, ns_of_reduction;  ///< on the same drawn flights
  std::string speed_of;                                 ///< which flights these were
  bool failed = false;                                  ///< another program broke
  bool times = false;                                   ///< wrong times count

  compare::Tally total() const;

  /// right, wrong, ill-posed, undecided, broken: the worst that applies (docs/judge.md).
  std::string verdict() const;
  /// The verdict in one line, with the most frequent fault, shares, times, free paths and speed.
  std::string line() const;

  std::string text() const;
  std::string json() const;
};

}  // namespace lorentz::cli
