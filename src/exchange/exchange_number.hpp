// Text to binary64: the nearest one, ties to even, however many digits. All numbers of all inputs are
// converted here, from their own text. Private to this repository.
#pragma once

#include <optional>
#include <string_view>

namespace lorentz {

inline bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Is the text a JSON number? -?(0|[1-9][0-9]*)([.][0-9]+)?([eE][+-]?[0-9]+)?
bool is_json_number(std::string_view text);

/// Reads [+-]? and digits, perhaps with one point before, among or behind them, perhaps [eE][+-]?[0-9]+.
/// Nothing if the text is not such a number. A number nearer to 0 than to the smallest subnormal becomes 0;
/// one that rounds to more than the largest binary64 becomes infinite.
std::optional<double> nearest_decimal(std::string_view text);

/// The same for [+-]?0[xX], hexadecimal digits, perhaps with a point, perhaps [pP][+-]?[0-9]+.
std::optional<double> nearest_hexadecimal(std::string_view text);

}  // namespace lorentz
