// One of several names, or what was meant by a mistyped one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lorentz {

/// The name that takes the fewest typing mistakes (a character too many, missing, wrong, or two exchanged),
/// if they are at most a third of it; else empty. Of several the first.
std::string nearest_name(std::string_view typed, const std::vector<std::string>& names);

/// " (did you mean NAME?)", or empty, also if the text is one of the names (and stands where it means
/// nothing).
std::string did_you_mean(std::string_view typed, const std::vector<std::string>& names);

/// Which of the names it is. Throws InputError, which begins with `what` and lists them, if it is not one.
std::size_t index_of_name(const std::string& name, const std::vector<std::string>& names,
                          std::string_view what);

}  // namespace lorentz
