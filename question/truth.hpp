// The engine whose answers are the truth by which other engines are judged.
#pragma once

#include <string>
#include <vector>

#include "question/engines.hpp"

namespace lorentz::question {

enum class Truth {
  oracle,    ///< the exact oracle: shares no arithmetic with any engine
  certified  ///< the same answers, many times faster, if the fast engine's filters are right
};

inline constexpr const char* kJudgeHelp =
    "whose answers are the truth: oracle, or certified, which is faster and rests on reduction";

/// The truth that `--judge NAME` selects. Throws InputError for an unknown name, and if a judged engine rests
/// on the engine that would judge it.
Truth truth_named(const std::string& name, const std::vector<EngineInfo>& judged);

}  // namespace lorentz::question
