// The manual pages: the tree of subcommands and options of --help, in the format of man.
#pragma once

#include <string>

#include "cli/command.hpp"

namespace lorentz::cli {

/// Writes a page for the program and for each subcommand, at any depth, into a folder: lorentz.1,
/// lorentz-scene.1, lorentz-scene-draw.1. The folder is created if it does not exist. The date of the pages
/// is SOURCE_DATE_EPOCH, in seconds, or today. Throws FileError.
void write_manuals(const Command& program, const std::string& folder);

}  // namespace lorentz::cli
