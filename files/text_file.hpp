// The text of a file.
#pragma once

#include <string>

namespace lorentz {

/// The whole text of a file, or of standard input for "-". Throws FileError.
std::string text_of_file(const std::string& path);

}  // namespace lorentz
