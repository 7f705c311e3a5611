// Ctrl-C in work that does not hold the interpreter's lock. Private to python/.
#pragma once

#include <atomic>
#include <chrono>
#include <future>

#include "python/module.hpp"

namespace lorentz::python {

/// Checks for Ctrl-C from within a loop. look() may be called often, because it takes the lock only at
/// intervals.
class SignalWatch {
 public:
  /// Throws py::error_already_set for Ctrl-C. The caller must not hold the lock.
  void look() {
    const Clock::time_point now = Clock::now();
    if (now < next_) return;
    next_ = now + kBetween;
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kBetween{50};
  Clock::time_point next_ = Clock::now() + kBetween;
};

/// Runs `work` in a separate thread and checks for Ctrl-C in the meantime. Ctrl-C sets `stop` and is thrown
/// when the work has ended. The caller must not hold the lock.
template <class Work>
auto watched(std::atomic<bool>& stop, const Work& work) {
  auto result = std::async(std::launch::async, work);
  SignalWatch watch;
  while (result.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
    try {
      watch.look();
    } catch (...) {
      stop = true;
      result.wait();
      throw;
    }
  }
  return result.get();
}

/// Returns the result of `find(stop)`, which runs while other Python threads run. Ctrl-C ends it.
template <class Find>
auto found_by(const Find& find) {
  const py::gil_scoped_release release;
  std::atomic<bool> stop = false;
  return watched(stop, [&] { return find(stop); });
}

}  // namespace lorentz::python
