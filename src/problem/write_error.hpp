// What cannot be written: where, why, and what can be done about it.
#pragma once

#include <string>

#include <lorentz/errors.hpp>

namespace lorentz {

/// "PLACE: No space left on device; free some, or write to another disk", of an errno.
FileError write_error(const std::string& place, int error_number);

}  // namespace lorentz
