// Numbers on the command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.hpp"

namespace lorentz::cli {

/// A whole number from `least` to `most`: digits, or a form such as 1e6. Throws InputError with the option's
/// name.
std::uint64_t whole_number(const std::string& text, const char* option, std::uint64_t least,
                           std::uint64_t most);

/// A finite number above zero, decimal or hexadecimal; empty if the option was not given. Throws InputError.
std::optional<double> positive_number(const std::optional<std::string>& text, const char* option);

/// A finite number, 0 or above. Throws InputError with the option's name.
double number_from_zero(const std::string& text, const char* option);

/// The size of a picture, W or WxH in pixels, each from 200 to 20 000. Throws InputError with the name
/// --size.
struct PictureSize {
  double width;
  std::optional<double> height;
};
PictureSize picture_size(const std::string& text);

/// The numbers of a list with commas between them. Throws InputError with the option's name.
std::vector<double> numbers_in(const std::string& list, const char* option);

/// Stores the given number in the option's destination. Throws InputError with the option's name.
void take_number(const Option& option, const std::string& text);

/// Makes each given list with commas in it several values. Throws InputError with the option's name if an item is
/// empty.
void split_at_commas(const Option& option);

}  // namespace lorentz::cli
