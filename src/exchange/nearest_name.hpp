// One of several names, or the name that was meant by a mistyped one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lorentz {

/// The name that takes the fewest typing mistakes (a character too many, missing, wrong, or two exchanged),
/// if they are at most a third of `typed`; otherwise empty. If there are several, the first.
std::string nearest_name(std::string_view typed, const std::vector<std::string>& names);

/// " (did you mean NAME?)", or empty. It is also empty if the text is one of the names (in a place where it
/// has no meaning).
std::string did_you_mean(std::string_view typed, const std::vector<std::string>& names);

/// The number of the name in the list. If it is not there, throws InputError, which begins with `what` and
/// lists the names.
std::size_t index_of_name(const std::string& name, const std::vector<std::string>& names,
                          std::string_view what);

/// The items of a list with commas between them. From an item on of which `is_rest` is true, the whole rest is one
/// item, commas included. Throws InputError, which begins with `what`, if an item is empty.
std::vector<std::string> items_of(std::string_view list, std::string_view what,
                                  bool (*is_rest)(std::string_view) = nullptr);

}  // namespace lorentz
