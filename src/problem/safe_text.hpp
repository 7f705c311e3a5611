// Text from elsewhere (other programs, stores, files, the command line) that is to be shown: always valid
// UTF-8, and nothing in it acts on a terminal. The one place that says which characters do.
#pragma once

#include <string>
#include <string_view>

namespace lorentz {

/// The first character of a text.
struct Character {
  char32_t code = 0;      ///< U+FFFD if the bytes are not UTF-8
  std::size_t bytes = 1;  ///< that it takes; of bytes that are not UTF-8: to be passed over together
  bool acts = false;  ///< a control character (C0, DEL, C1), or one that turns the direction or ends the line
  bool is_text = true;  ///< its bytes are UTF-8
};

/// Of a text that is not empty.
Character first_character(std::string_view text);

enum class Lines { escaped, kept };

/// For terminals, tables and pictures: characters that act are written as \x1b or \u202e, bytes that are not
/// UTF-8 as U+FFFD. With Lines::kept line ends and tabs stay.
std::string printable(std::string_view text, Lines lines = Lines::escaped);

/// The beginning, at most `most` bytes of it, that ends between two characters; and "..." if something is
/// left out.
std::string shortened(std::string_view text, std::size_t most);

/// Characters of a text, each taken as one column wide.
std::size_t width_of(std::string_view text);

}  // namespace lorentz
