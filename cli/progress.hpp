// A progress bar on a terminal's stderr; nothing at all when stderr is no terminal. LORENTZ_PROGRESS_AFTER
// says from which second of the work on it is drawn, 1 unless set: with 0, even short work shows it.
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

  /// Looks at the clock at every `stride`-th count only. `begun`: of several bars one after the other, when
  /// the first did.
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

  /// `done` of the total are done; draws a few times a second, once the work has taken a while.
  void at(std::size_t done) {
    at(done, [] { return std::string(); });
  }

  /// With a note beside the bar, which is asked for when it is drawn.
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

 private:
  static std::chrono::milliseconds patience() {
    const char* seconds = std::getenv("LORENTZ_PROGRESS_AFTER");
    return std::chrono::milliseconds(seconds ? std::lround(1e3 * std::atof(seconds)) : 1000);
  }

  std::string what_;
  std::size_t total_, stride_;
  bool shown_, drawn_ = false;
  Clock::time_point next_;
};

}  // namespace lorentz::cli
