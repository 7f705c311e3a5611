// Texts that the help of several commands shares.
#pragma once

#include <fmt/format.h>

#include <string>

#include "question/engines.hpp"

namespace lorentz::cli {

/// The names of all engines, with `cmd:COMMAND` and `lib:FILE.so`.
inline std::string names_for_help() {
  return fmt::format("{}, cmd:COMMAND (a program), lib:FILE.so (a shared library)",
                     fmt::join(question::own_names(), ", "));
}

inline constexpr const char* kEngineHelp =
    "an engine that `lorentz --help` lists, cmd:COMMAND (a program) or lib:FILE.so (a shared library)";

inline constexpr const char* kTimeoutHelp =
    "how long a cmd: or lib: engine may take for an answer (default: 60)";

}  // namespace lorentz::cli
