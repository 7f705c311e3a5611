// Text from elsewhere (other programs, stores, files, the command line) made safe to show: always valid
// UTF-8, and nothing in it acts on a terminal. This is the only place that says which characters act.
#pragma once

#include <string>
#include <string_view>

namespace lorentz {

/// True for control characters, line and paragraph separators, the marks and overrides of the writing
/// direction, the byte order mark, and the two code points that XML excludes.
bool acts(char32_t code);
/// Appends \\x, or \\u, and two or four hexadecimal digits.
void append_escape(std::string& out, char32_t code, int digits);

/// The first character of a text.
struct Character {
  char32_t code = 0;      ///< U+FFFD if the bytes are not UTF-8
  std::size_t bytes = 1;  ///< its length; if the bytes are not UTF-8, how many to skip together
  bool acts = false;      ///< as the function
  bool is_text = true;    ///< its bytes are UTF-8
};

/// Requires a text that is not empty.
Character first_character(std::string_view text);

enum class Lines { escaped, kept };

/// The text for terminals, tables and pictures: characters that act are written as \x1b or \u202e, and bytes
/// that are not UTF-8 as U+FFFD. Lines::kept leaves line ends and tabs as they are.
std::string printable(std::string_view text, Lines lines = Lines::escaped);

/// At most the first `most` bytes, cut between two characters; "..." follows if something is left out.
std::string shortened(std::string_view text, std::size_t most);

/// The number of characters, each taken as one column wide.
std::size_t width_of(std::string_view text);

}  // namespace lorentz
