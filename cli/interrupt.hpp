// Ctrl-C, SIGTERM and SIGHUP as a request to finish.
#pragma once

#include <signal.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <ctime>

#include "question/process.hpp"

namespace lorentz::cli {

/// While an Interrupt exists, the first such signal only sets a flag. A second signal, at least half a second
/// later, ends the programs that this process started and then has its previous effect. (Senders such as
/// `timeout` or a closing terminal often send a signal both to the process and to its group.) Signals that
/// the caller ignores stay ignored.
class Interrupt {
 public:
  Interrupt() {
    came_ = false;
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
      struct sigaction ours {};
      ours.sa_handler = take;
      if (sigaction(kSignals[i], nullptr, &before_[i]) == 0 && before_[i].sa_handler != SIG_IGN)
        sigaction(kSignals[i], &ours, nullptr);
    }
  }
  ~Interrupt() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  }
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static const std::atomic<bool>& came() { return came_; }
  /// "interrupted", "terminated" (SIGTERM) or "hung up" (SIGHUP), if one came.
  static const char* what() {
    return number_ == SIGTERM ? "terminated" : number_ == SIGHUP ? "hung up" : "interrupted";
  }

 private:
  static void take(int number) {
    const std::int64_t now = milliseconds();
    if (!came_.exchange(true)) {
      number_ = number;
      first_ = now;
      return;
    }
    if (now - first_ < kSameWish) return;
    question::kill_programs();
    for (std::size_t i = 0; i < kSignals.size(); ++i)
      if (kSignals[i] == number) sigaction(number, &before_[i], nullptr);
    raise(number);  // blocked until this returns
  }

  static std::int64_t milliseconds() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{1000} * now.tv_sec + now.tv_nsec / 1'000'000;
  }

  static constexpr std::int64_t kSameWish = 500;
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
  static_assert(std::atomic<bool>::is_always_lock_free &&
                std::atomic<std::int64_t>::is_always_lock_free);  // a signal handler must not wait
  static inline std::atomic<bool> came_ = false;
  static inline std::atomic<int> number_ = 0;
  static inline std::atomic<std::int64_t> first_ = 0;
  static inline std::array<struct sigaction, kSignals.size()> before_{};
};

}  // namespace lorentz::cli
