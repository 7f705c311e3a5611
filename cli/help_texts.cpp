#include "cli/help_texts.hpp"

#include <fmt/format.h>

#include "question/engines.hpp"

namespace lorentz::cli {

std::string names_for_help() {
  return fmt::format("{}, cmd:COMMAND (a program), lib:FILE.so (a shared library)",
                     fmt::join(question::own_names(), ", "));
}

}  // namespace lorentz::cli
