// Texts that the help of several commands shares.
#pragma once

#include <string>

namespace lorentz::cli {

/// The names of all engines, with `cmd:COMMAND` and `lib:FILE.so`.
std::string names_for_help();

inline constexpr const char* kEngineHelp =
    "an engine that `lorentz --help` lists, cmd:COMMAND (a program) or lib:FILE.so (a shared library)";

inline constexpr const char* kTimeoutHelp =
    "how long a cmd: or lib: engine may take for an answer (default: 60)";

}  // namespace lorentz::cli
