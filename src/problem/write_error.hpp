// Errors of files that cannot be written: where, why, and what can be done about it.
#pragma once

#include <string>

#include <lorentz/errors.hpp>

namespace lorentz {

/// The error for an errno, such as "PLACE: No space left on device; free some, or write to another disk".
FileError write_error(const std::string& place, int error_number);

}  // namespace lorentz
