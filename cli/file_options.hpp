// Checks that no file to be written is also named by another option.
#pragma once

#include <string>

#include "cli/command.hpp"

namespace lorentz::cli {

/// Called after the options are parsed and before anything is written. Throws InputError if the name of a
/// file to be written is empty; if the file, or standard output, is also read, or written by another option;
/// or if it exists and is a store, or of another kind than what would replace it. Different names of a file
/// (links, the name of a scene, standard input) count as the same file. The files among the words of an
/// engine's command count as read. Devices and pipes may be named several times.
void check_files(const Command& command);

/// The first 4096 bytes of a file that is to be replaced, without white space in front. Empty if there is no
/// such file, if it holds nothing else or cannot be read, and for devices.
std::string beginning_of(const std::string& path);

}  // namespace lorentz::cli
