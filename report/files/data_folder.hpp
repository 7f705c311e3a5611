// The project's own data, wherever the program was built or installed.
#pragma once

#include <string>
#include <vector>

namespace lorentz {

/// The files with this extension in data/FOLDER, in order. The data folder is the one that LORENTZ_DATA
/// names, or the one beside the build folder, or the installed one, or one that was added. Empty if there is
/// no such folder. Throws FileError if LORENTZ_DATA is set but does not name a folder with scenes or golden
/// sets.
std::vector<std::string> data_files(const std::string& folder, const std::string& extension);

/// Adds a folder to search after the others, for a caller that is not a program and has its data elsewhere.
void add_data_folder(const std::string& path);

/// The places that are searched, for messages.
std::string data_places(const std::string& folder);

}  // namespace lorentz
