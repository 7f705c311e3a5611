// Judges one engine: the work of `lorentz judge` between its options and its report.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "judge/judge_report.hpp"

namespace lorentz::judge {

/// What to examine, and how.
struct JudgeOrder : JudgeTerms {
  bool quick = false;               ///< fewer flights in less time
  std::optional<double> time = {};  ///< seconds in all; nothing: the usual time
  /// The number of questions of each row, instead of a time: every machine asks the same.
  std::optional<std::size_t> questions = {};
  unsigned jobs = 1;                   ///< threads of the campaign; one if questions are counted
  std::optional<double> timeout = {};  ///< for an external engine; nothing: a tenth of the time
  question::Listener listener = {};
  std::function<void(const std::string& row)> on_progress = {};  ///< called often, with the name of the row
  OnJudged on_judged = {};  ///< called for each answer, if questions are counted
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();  ///< of the time

  /// Duration from `begun` on; meaningless if questions are counted. Only an engine of this program or of the
  /// caller, which cannot be interrupted, makes the run longer.
  double seconds() const;
};

/// The number of rows of a report.
std::size_t number_of_rows(const JudgeOrder& order);

/// The full report on the engine; once `stop` is set, what was found until then. Throws FileError without the
/// catalogue or the golden sets.
JudgeReport judged(const JudgeOrder& order, const std::atomic<bool>& stop);

}  // namespace lorentz::judge
