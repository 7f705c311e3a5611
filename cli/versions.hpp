// The libraries that the program is linked with.
#pragma once

#include <string>
#include <vector>

namespace lorentz::cli {

/// "GMP 6.2.1", ..: the libraries for computing, reading, storing and printing.
std::vector<std::string> library_versions();

}  // namespace lorentz::cli
