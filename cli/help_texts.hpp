// Texts that the help of several commands shares.
#pragma once

#include <string>

namespace lorentz::cli {

/// The names of all engines, with `cmd:COMMAND` and `lib:FILE.so`.
std::string names_for_help();

inline constexpr const char* kTimeoutHelp =
    "how long a cmd: or lib: engine may be silent while it owes answers (default: 60)";

inline constexpr const char* kJudgeHelp =
    "whose answers are the truth: oracle, or certified, which is faster and rests on reduction";

}  // namespace lorentz::cli
