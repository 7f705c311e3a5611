#include "src/exchange/exchange_toml.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <lorentz/errors.hpp>
#include <lorentz/exchange.hpp>
#include "src/exchange/exchange_number.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz {
namespace {

// The characters of bare keys, numbers and dates. A piece that consists of these is one of them, or is not
// valid.
bool is_bare(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         std::string_view("_+-.:").find(c) != std::string_view::npos;
}

// TOML's decimal numbers are those of JSON, perhaps with a plus sign, and with underscores between digits. An
// exponent may have leading zeros (in JSON, too). Empty if the piece is not such a number.
std::string as_json_number(std::string_view piece) {
  if (piece.starts_with('+')) piece.remove_prefix(1);
  const std::string framed = ' ' + std::string(piece) + ' ';
  std::string number;
  for (std::size_t i = 1; i + 1 < framed.size(); ++i)
    if (framed[i] != '_' || !is_digit(framed[i - 1]) || !is_digit(framed[i + 1])) number += framed[i];
  return is_json_number(number) ? number : "";
}

// The end of the string that begins at `start`; the text's end, if the string does not end.
std::size_t after_string(std::string_view toml, std::size_t start) {
  const char quote = toml[start];
  const std::string mark(toml.substr(start).starts_with(std::string(3, quote)) ? 3 : 1, quote);
  for (std::size_t i = start + mark.size(); i < toml.size(); ++i) {
    if (quote == '"' && toml[i] == '\\')
      ++i;
    else if (mark.size() == 1 && toml[i] == '\n')
      return i;                                 // not TOML, as the parser will report
    else if (toml.substr(i).starts_with(mark))  // of up to five quotes the last three end it
      return mark.size() == 1 ? i + 1 : std::min(toml.find_first_not_of(quote, i), toml.size());
  }
  return toml.size();
}

// The end of the piece that begins at `start`: a string, a comment, a bare word, or another character.
std::size_t after_piece(std::string_view toml, std::size_t start) {
  const char c = toml[start];
  if (c == '"' || c == '\'') return after_string(toml, start);
  if (c == '#') return std::min(toml.find('\n', start), toml.size());
  if (!is_bare(c)) return start + 1;
  return static_cast<std::size_t>(std::find_if_not(toml.begin() + start, toml.end(), is_bare) - toml.begin());
}

void append_hexadecimal(std::string& out, double value) {
  char digits[32];
  char* end = std::to_chars(digits, std::end(digits), std::fabs(value), std::chars_format::hex).ptr;
  out += std::signbit(value) ? "\"-0x" : "\"0x";
  out.append(std::begin(digits), end);
  out += '"';
}

}  // namespace

// A bare key that looks like a number gets another name. No reader asks for a key of either name.
std::string with_hexadecimal_numbers(std::string_view toml) {
  std::string out;
  for (std::size_t start = 0, end; start < toml.size(); start = end) {
    end = after_piece(toml, start);
    const std::string_view piece = toml.substr(start, end - start);
    const std::string number = as_json_number(piece);
    if (number.empty()) {
      out += piece;
      continue;
    }
    const double value = *nearest_decimal(number);
    if (std::isinf(value))
      throw InputError("line " + std::to_string(1 + std::count(out.begin(), out.end(), '\n')) + ": " +
                       json_quoted(shortened(piece, 40)) + " is beyond the range of binary64");
    append_hexadecimal(out, value);
  }
  return out;
}

}  // namespace lorentz
