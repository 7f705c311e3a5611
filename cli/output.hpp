// Standard output: texts, and streams. Streams are gathered into large writes, which are not delayed for
// long.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

#include "report/files/messages.hpp"

namespace lorentz::cli {

/// Writes data on stdout, byte for byte: golden sets quote the lines of others.
inline void print_data(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
}

/// Prints text on stdout. Characters that act on a terminal are escaped; line ends and tabs stay. At its end the
/// program checks that all text arrived (finish_output).
inline void print(std::string_view text) {
  print_data(printable(text, Lines::kept));
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
