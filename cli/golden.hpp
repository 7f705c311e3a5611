// The parts of `lorentz golden`, one file each.
#pragma once

#include "cli/command.hpp"

namespace lorentz::cli {

Command golden_make_command();
Command golden_check_command();
Command golden_verify_command();
Command golden_list_command();
Command golden_explain_command();

/// The committed sets: every *.ndjson in data/golden, by name. Empty if the folder is not there.
std::vector<std::string> committed_sets();

/// The file of a set: a file (or a folder), or the name of a committed set. Throws FileError, naming the
/// sets.
std::string find_set(const std::string& name_or_file);

/// Those, of a folder every *.ndjson in it, or all committed sets if none is named. Throws FileError if there
/// are none.
std::vector<std::string> find_sets(const std::vector<std::string>& names_or_files);

}  // namespace lorentz::cli
