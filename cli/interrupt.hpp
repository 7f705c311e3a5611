// Ctrl-C as a wish to come to an end.
#pragma once

#include <signal.h>

#include <atomic>

namespace lorentz::cli {

/// While one of these is there the first Ctrl-C only sets a flag. The second ends the program as SIGTERM
/// does: with other programs that it started.
class Interrupt {
 public:
  Interrupt() {
    came_ = false;
    struct sigaction action {};
    action.sa_handler = [](int) {
      if (came_.exchange(true)) raise(SIGTERM);
    };
    sigaction(SIGINT, &action, &before_);
  }
  ~Interrupt() { sigaction(SIGINT, &before_, nullptr); }
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static const std::atomic<bool>& came() { return came_; }

 private:
  static_assert(std::atomic<bool>::is_always_lock_free);  // a handler may not wait
  static inline std::atomic<bool> came_ = false;
  struct sigaction before_ {};
};

}  // namespace lorentz::cli
