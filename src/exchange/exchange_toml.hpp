// The numbers of a TOML text. Private to the exchange formats.
#pragma once

#include <string>
#include <string_view>

namespace lorentz {

/// The text with each decimal number in the notation "0x1.8p-1", in quotes, which is accepted wherever a
/// number is. This is needed because toml++ rejects numbers of more than 128 characters, integers beyond
/// 2^63, and numbers that are rounded to 0. Lines keep their places. Throws InputError, with the line, if a
/// number is beyond the range of binary64.
std::string with_hexadecimal_numbers(std::string_view toml);

}  // namespace lorentz
