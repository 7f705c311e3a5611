// What may stand next on a command line: for the shells, whose functions ask `lorentz --complete WORD..`.
#pragma once

#include <string>
#include <vector>

#include "cli/command.hpp"

namespace lorentz::cli {

/// The words that may take the place of the last of `words`, which is being typed (the name of the program
/// left out): one a line, what it means behind a tab. Before them a line that says whether the name of a file
/// may stand there, too: "files" or "words".
std::string completions(const Command& program, const std::vector<std::string>& words);

}  // namespace lorentz::cli
