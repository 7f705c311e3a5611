// Standard output: texts, and streams. Streams are gathered into large writes, which are not delayed for
// long.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

#include "report/files/messages.hpp"

namespace lorentz::cli {

/// Prints text on stdout. Characters that act on a terminal are escaped; line ends and tabs stay. JSON and
/// SVG contain no such characters. At its end the program checks that all text arrived (finish_output).
inline void print(std::string_view text) {
  const std::string shown = printable(text, Lines::kept);
  std::fwrite(shown.data(), 1, shown.size(), stdout);
}

/// Throws FileError if printed text did not arrive.
void finish_output();

class Output {
 public:
  std::string& buffer() { return buffer_; }
  /// Writes the buffer if it is large or the last write was long ago.
  void flush_if_due();
  /// Throws FileError.
  void flush();

 private:
  std::string buffer_;
  std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
};

}  // namespace lorentz::cli
