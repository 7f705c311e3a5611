// An earlier report, and what is worse in a later one.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "judge/judge_report.hpp"

namespace lorentz::judge {

/// What `lorentz judge --json` printed about an engine.
class Baseline {
 public:
  /// `json`: the report; `name`: its name in messages. Throws InputError if it is not such a report.
  Baseline(const std::string& json, const std::string& name);

  /// A sentence for each new kind of fault, and for each row that asked the same number of questions then and
  /// now and has more answers that are wrong, errors or missing now. With `times` wrong times are faults,
  /// too.
  std::vector<std::string> worse(const JudgeReport& report, bool times) const;

  /// The rows that asked another number of questions; their wrong answers are not compared.
  std::vector<std::string> not_compared(const JudgeReport& report) const;

 private:
  struct RowBefore {
    std::size_t queries = 0, failed = 0;
  };
  std::map<std::string, RowBefore> rows_;
  std::set<std::pair<std::string, std::string>> faults_;  // verdict and cause
};

}  // namespace lorentz::judge
