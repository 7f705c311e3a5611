// Services for shells and the build, from the tree of subcommands and options that --help shows.
#pragma once

#include <string>
#include <vector>

#include "cli/command.hpp"

namespace lorentz::cli {

/// The completions of the last of `words`, which is being typed, for the functions of shells, which call
/// `lorentz --complete WORD..`. `words` does not include the name of the program. One completion per line,
/// with its meaning after a tab. The first line is "files" if a file name is possible, too, else "words".
std::string completions(const Command& program, const std::vector<std::string>& words);

/// Writes a manual page for the program and for each subcommand, at any depth, into a folder, in the format
/// of man: lorentz.1, lorentz-scene.1, lorentz-scene-draw.1. The folder is created if it does not exist. The
/// date of the pages is SOURCE_DATE_EPOCH, in seconds, or today. Throws FileError.
void write_manuals(const Command& program, const std::string& folder);

}  // namespace lorentz::cli
