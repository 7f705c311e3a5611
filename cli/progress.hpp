// A progress bar on stderr if it is a terminal; else nothing. LORENTZ_PROGRESS_AFTER is the number of seconds
// after which the bar appears, by default 1. With 0, even short work shows it. Where a campaign writes lines
// instead, they come 60 times as late.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "src/problem/safe_text.hpp"

namespace lorentz::cli {

class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  /// Reads the clock only at every `stride`-th count. `begun`: the beginning of the first bar if several bars
  /// follow one another.
  explicit Progress(const std::string& what, std::size_t total, std::size_t stride = 64,
                    Clock::time_point begun = Clock::now())
      : what_(printable(what)),
        total_(total),
        stride_(stride),
        shown_(isatty(STDERR_FILENO) == 1),
        next_(begun + patience()) {}
  ~Progress() {
    if (drawn_) std::fputs("\r\033[K", stderr);
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  const std::string& what() const { return what_; }
  std::size_t total() const { return total_; }

  /// Reports that `done` of the total are done. Draws several times a second once the work has taken long
  /// enough.
  void at(std::size_t done) {
    at(done, [] { return std::string(); });
  }

  /// The same with a note beside the bar; `note` is called when the bar is drawn.
  template <class Note>
  void at(std::size_t done, const Note& note) {
    if (!shown_ || done % stride_ != 0) return;
    const auto now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(200);
    constexpr std::size_t kWidth = 40;
    const std::size_t full = total_ && done < total_ ? kWidth * done / total_ : kWidth;
    std::string beside = note();
    if (!beside.empty()) beside = ", " + beside;
    std::fprintf(stderr, "\r%s [%s%s] %zu of %zu%s\033[K", what_.c_str(), std::string(full, '#').c_str(),
                 std::string(kWidth - full, ' ').c_str(), done, total_, beside.c_str());
    drawn_ = true;
  }

  static std::chrono::milliseconds patience() {
    const char* seconds = std::getenv("LORENTZ_PROGRESS_AFTER");
    return std::chrono::milliseconds(seconds ? std::lround(1e3 * std::atof(seconds)) : 1000);
  }

 private:
  std::string what_;
  std::size_t total_, stride_;
  bool shown_, drawn_ = false;
  Clock::time_point next_;
};

}  // namespace lorentz::cli
