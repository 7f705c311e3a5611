// Threads that share work.
#pragma once

#include <future>
#include <system_error>
#include <thread>
#include <vector>

namespace lorentz {

/// Threads that do `work`: `most` of them, or as many as the system starts.
template <class Work>
std::vector<std::jthread> threads_of(std::size_t most, const Work& work) {
  std::vector<std::jthread> threads;
  try {
    while (threads.size() < most) threads.emplace_back(work);
  } catch (const std::system_error&) {  // those that there are do it all
  }
  return threads;
}

/// For std::async: if no thread can be started, the work is done when its result is asked for. Named work, which
/// is copied: what libstdc++ gave to a thread in vain is lost.
inline constexpr auto kInThreadIfPossible = std::launch::async | std::launch::deferred;

}  // namespace lorentz
