#include "cli/output.hpp"

#include <unistd.h>

#include <cerrno>

#include "src/problem/write_error.hpp"

namespace lorentz::cli {

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
