// The project's own data, wherever the program was built or installed.
#pragma once

#include <string>
#include <vector>

namespace lorentz {

/// The files with this extension in data/FOLDER, in order: of the data folder that LORENTZ_DATA names, or of
/// the one beside the build folder, or of the one installed, or of one that was added. None if there is no
/// such folder. Throws FileError if LORENTZ_DATA is set, and is no folder with scenes or golden sets.
std::vector<std::string> data_files(const std::string& folder, const std::string& extension);

/// Another folder to look for them in, after the others: for who is no program, and has its data elsewhere.
void add_data_folder(const std::string& path);

/// Where it looks for them, for messages.
std::string data_places(const std::string& folder);

}  // namespace lorentz
