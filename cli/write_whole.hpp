// Files that are there whole or not at all.
#pragma once

#include <string>

namespace lorentz::cli {

/// Writes beside the file and renames when all is on the disk: whenever the program ends, the file is the old
/// one or the new one. What is no regular file (a device, a pipe) is written to as it is. Throws FileError.
void write_whole(const std::string& file, const std::string& text);

/// True if the file is there and begins like no SVG, so that overwriting it would lose something else. An
/// empty one is nobody's loss. Throws FileError if it cannot be read.
bool is_other_than_svg(const std::string& file);

}  // namespace lorentz::cli
