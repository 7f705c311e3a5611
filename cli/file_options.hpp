// Checks that no file to be written is also named by another option.
#pragma once

#include <string>

#include "cli/command.hpp"

namespace lorentz::cli {

/// Called after the options are parsed and before anything is written. Throws InputError if the name of a
/// file to be written is empty, or `-` where standard output makes no sense; if the file, or standard output,
/// is also read, or written by another option; if it is the running program; or if it exists and is of
/// another kind than what would replace it. Different names of a file (links, the name of a scene, standard
/// input) count as the same file. The files among the words of an engine's command count as read. Devices and
/// pipes may be named several times.
void check_files(const Command& command);

enum class OutputKind { golden_set, queries, picture, page, test_report, table };

/// Throws InputError if there is a file that holds something and does not begin as one of this kind; the
/// message begins with `by`, an option. Throws FileError if the file cannot be read.
void refuse_other_kinds(const std::string& path, OutputKind kind, const std::string& by = "");

}  // namespace lorentz::cli
