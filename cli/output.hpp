// Standard output of streams, gathered into large writes, none of which is held back for long.
#pragma once

#include <chrono>
#include <string>

namespace lorentz::cli {

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
