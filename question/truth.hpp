// Whose answers are the truth that others are judged by.
#pragma once

#include <string>
#include <vector>

#include "question/engines.hpp"

namespace lorentz::question {

enum class Truth {
  oracle,    ///< the exact oracle: shares no arithmetic with any engine
  certified  ///< the same answers, many times faster, on the word of the fast engine's filters
};

inline constexpr const char* kJudgeHelp =
    "whose answers are the truth: oracle, or certified, which is faster and rests on reduction";

/// What an option `--judge` calls it. Throws InputError for another name, and where one of the judged rests
/// on what would judge it.
Truth truth_named(const std::string& name, const std::vector<EngineInfo>& judged);

}  // namespace lorentz::question
