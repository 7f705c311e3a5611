// The manual pages: the same tree of subcommands and options that --help shows, written for man.
#pragma once

#include <string>

#include "cli/command.hpp"

namespace lorentz::cli {

/// Writes a page for the program and for each subcommand, at any depth, into a folder that is made if it is
/// not there: lorentz.1, lorentz-scene.1, lorentz-scene-draw.1. Their date is SOURCE_DATE_EPOCH, in seconds,
/// or today. Throws FileError.
void write_manuals(const Command& program, const std::string& folder);

}  // namespace lorentz::cli
