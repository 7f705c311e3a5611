// Golden sets by name, by file and by folder.
#pragma once

#include <string>
#include <vector>

namespace lorentz::golden {

/// The committed sets: every *.ndjson in data/golden, by name. Empty if the folder does not exist.
std::vector<std::string> committed_sets();

/// The file of a set, given a file (or a folder) or the name of a committed set. Throws InputError for a name that no
/// set has, listing the sets, and FileError for a file that is not there.
std::string find_set(const std::string& name_or_file);

/// The files of these sets; for a folder every *.ndjson in it; all committed sets if no name is given. Throws
/// FileError if there are none.
std::vector<std::string> find_sets(const std::vector<std::string>& names_or_files);

}  // namespace lorentz::golden
