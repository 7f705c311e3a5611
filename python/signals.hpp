// Ctrl-C in work that does not hold the interpreter's lock. Private to python/.
#pragma once

#include <atomic>
#include <chrono>
#include <future>

#include "python/module.hpp"

namespace lorentz::python {

/// Looks for Ctrl-C from within a loop, where it is asked often and takes the lock now and then.
class SignalWatch {
 public:
  /// Throws py::error_already_set, what Ctrl-C means to Python. Not with the lock held.
  void look();

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kBetween{50};
  Clock::time_point next_ = Clock::now() + kBetween;
};

/// Has `work` done in a thread of its own and looks for Ctrl-C meanwhile, which sets `stop` and is thrown
/// when the work has ended. Not with the lock held.
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

}  // namespace lorentz::python
