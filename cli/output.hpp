// Standard output: texts, and streams that are gathered into large writes, none of which is held back for long.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

#include "files/messages.hpp"

namespace lorentz::cli {

/// Text on stdout, with what acts on a terminal escaped; line ends and tabs stay. JSON and SVG contain no
/// such characters. The end of the program checks that all text arrived (finish_output).
inline void print(std::string_view text) {
  const std::string shown = printable(text, Lines::kept);
  std::fwrite(shown.data(), 1, shown.size(), stdout);
}

/// Throws FileError if something printed did not arrive.
void finish_output();

class Output {
 public:
  std::string& buffer() { return buffer_; }
  /// Writes what is there if it is much, or if the last write was a while ago.
  void flush_if_due();
  /// Throws FileError.
  void flush();

 private:
  std::string buffer_;
  std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
};

}  // namespace lorentz::cli
