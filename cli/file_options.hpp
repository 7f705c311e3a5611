// Checks that no file to be written is also named by another option.
#pragma once

#include "cli/command.hpp"

namespace lorentz::cli {

/// Called after the options are parsed and before anything is written. Throws InputError if a file to be
/// written, including standard output, is also read, or written by another option. Different names of a file
/// (links, the name of a scene, standard input) count as the same file. Also throws if the name is empty.
/// Devices and pipes may be named several times.
void check_files(const Command& command);

}  // namespace lorentz::cli
