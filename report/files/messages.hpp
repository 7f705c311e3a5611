// Messages to people on stderr, and words quoted for a shell.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>

#include "src/problem/safe_text.hpp"

namespace lorentz {

/// Writes a message to stderr with the program's name in front; it has several lines if `lines` says so, else
/// one. If stderr is closed or full, only the message is lost.
inline void say_text(std::string_view message, Lines lines) {
  const std::string text = "lorentz: " + printable(message, lines) + '\n';
  std::fputs(text.c_str(), stderr);
}
template <class... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  say_text(fmt::format(format, std::forward<Args>(args)...), Lines::escaped);
}

/// A word for a shell: unchanged if possible, else in quotes. Characters that act on a terminal are escaped
/// ($'\x1b', of bash, zsh and ksh).
inline std::string shell_quoted(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:,=@%+";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  const bool acts = printable(word, Lines::kept) != word;
  std::string quoted = acts ? "$'" : "'";
  for (const char c : word) {
    if (c == '\'')
      quoted += acts ? "\\'" : "'\\''";
    else if (acts && (c == '\\' || c < ' ' || c > '~'))
      quoted += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      quoted += c;
  }
  return quoted + '\'';
}

}  // namespace lorentz
