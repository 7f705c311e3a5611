#include "cli/output.hpp"

#include <unistd.h>

#include <cerrno>
#include <iostream>

#include "src/problem/write_error.hpp"

namespace lorentz::cli {

void finish_output() {
  static bool is_lost = false;  // reported only once
  if (is_lost) return;
  std::cout.flush();
  const bool flushed = std::fflush(stdout) == 0;
  is_lost = !flushed || std::ferror(stdout) || !std::cout;
  if (is_lost) throw write_error("standard output", errno);
}

void Output::flush_if_due() {
  if (buffer_.size() >= (1 << 18) ||
      std::chrono::steady_clock::now() - flushed_ > std::chrono::milliseconds(200))
    flush();
}

void Output::flush() {
  for (std::size_t done = 0; done < buffer_.size();) {
    const ssize_t count = write(STDOUT_FILENO, buffer_.data() + done, buffer_.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw write_error("standard output", errno);
    done += static_cast<std::size_t>(count);
  }
  buffer_.clear();
  flushed_ = std::chrono::steady_clock::now();
}

}  // namespace lorentz::cli
