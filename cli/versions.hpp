// The libraries that the program is linked with.
#pragma once

#include <string>
#include <vector>

namespace lorentz::cli {

/// "GMP 6.2.1", ..: what computes, reads, stores, prints.
std::vector<std::string> library_versions();

}  // namespace lorentz::cli
