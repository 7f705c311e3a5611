// The numbers of a TOML text. Private to the exchange formats.
#pragma once

#include <string>
#include <string_view>

namespace lorentz {

/// The text with each decimal number in the notation "0x1.8p-1", in quotes, which is read wherever a number
/// is: toml++ gives up numbers of more than 128 characters, integers beyond 2^63, and what is rounded to 0.
/// The lines stay. Throws InputError, with the line, where a number is beyond binary64.
std::string with_hexadecimal_numbers(std::string_view toml);

}  // namespace lorentz
