// What the program says to people: messages on stderr, tables on stdout.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>

namespace lorentz::cli {

/// A message on stderr with the program's name in front. If stderr is closed or full the message is lost and
/// nothing else.
template <class... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  const std::string text = "lorentz: " + fmt::format(format, std::forward<Args>(args)...) + '\n';
  std::fputs(text.c_str(), stderr);
}

/// A word as a shell takes it: as it is if it can be, else in quotes.
inline std::string shell_quoted(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:,=@%+";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + '\'';
}

/// Text on stdout. That it arrived is checked once, at the program's end (finish_output).
inline void print(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
}

/// Throws FileError if something printed did not arrive.
void finish_output();

}  // namespace lorentz::cli
