// Judges one engine: the work of `lorentz judge` between its options and its report.
#pragma once

#include <atomic>

#include "judge/judge_report.hpp"

namespace lorentz::judge {

/// The number of rows of a report.
std::size_t number_of_rows(const JudgeOrder& order);

/// The full report on the engine; once `stop` is set, what was found until then. Throws FileError without the
/// catalogue or the golden sets.
JudgeReport judged(const JudgeOrder& order, const std::atomic<bool>& stop);

}  // namespace lorentz::judge
