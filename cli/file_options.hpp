// Options that name files: that none of those that are written is a file that another names.
#pragma once

#include "cli/command.hpp"

namespace lorentz::cli {

/// Once the options are parsed, before anything is written: throws InputError if a file to be written,
/// standard output included, is also read, or written by another option, whatever it is called there (links,
/// the name of a scene, standard input), or if its name is empty. Devices and pipes may stand anywhere.
void check_files(const Command& command);

}  // namespace lorentz::cli
