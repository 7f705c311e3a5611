// An earlier report, and in what a later one is worse.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "judge/judge_report.hpp"

namespace lorentz::judge {

/// What `lorentz judge --json` printed of an engine.
class Baseline {
 public:
  /// `json`: the report; `name`: what messages call it. Throws InputError if it is no such report.
  Baseline(const std::string& json, const std::string& name);

  /// A sentence for each kind of fault that is new, and for each row that asked as many questions then and has more
  /// answers that are wrong, errors or missing now. With `times` wrong times are faults, too.
  std::vector<std::string> worse(const JudgeReport& report, bool times) const;

  /// Rows that asked another number of questions: what they got wrong is not compared.
  std::vector<std::string> not_compared(const JudgeReport& report) const;

 private:
  struct RowBefore {
    std::size_t queries = 0, failed = 0;
  };
  std::map<std::string, RowBefore> rows_;
  std::set<std::pair<std::string, std::string>> faults_;  // verdict and cause
};

}  // namespace lorentz::judge
