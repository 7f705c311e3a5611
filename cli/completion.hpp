// Completions of a command line, for the functions of shells, which call `lorentz --complete WORD..`.
#pragma once

#include <string>
#include <vector>

#include "cli/command.hpp"

namespace lorentz::cli {

/// The completions of the last of `words`, which is being typed. `words` does not include the name of the
/// program. One completion per line, with its meaning after a tab. The first line is "files" if a file name
/// is possible, too, else "words".
std::string completions(const Command& program, const std::vector<std::string>& words);

}  // namespace lorentz::cli
