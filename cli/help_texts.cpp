#include "cli/help_texts.hpp"

#include <fmt/format.h>

#include "question/engines.hpp"

namespace lorentz::cli {

std::string names_for_help() {
  return fmt::format(
      "{}, cmd:COMMAND (an external program), lib:FILE.so (a shared library); docs/command_engines.md",
      fmt::join(question::own_names(), ", "));
}

}  // namespace lorentz::cli
