#include "chaos/groups.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>

namespace lorentz::chaos {

std::vector<bool> for_each_group(const Work& work, const std::function<void(std::uint64_t)>& act) {
  std::vector<bool> done(kGroups);
  std::uint64_t next = 0, finished = 0;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto take = [&](std::uint64_t& group) {
    const std::lock_guard lock(mutex);
    if (failure || work.is_stopped() || next == kGroups) return false;
    group = next++;
    return true;
  };
  const auto run = [&] {
    for (std::uint64_t group; take(group);) {
      try {
        act(group);
      } catch (...) {
        const std::lock_guard lock(mutex);
        failure = std::current_exception();
        return;
      }
      const std::lock_guard lock(mutex);
      done[group] = !work.is_stopped();
      if (work.on_progress) work.on_progress(++finished);
    }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned job = 1; job < std::min<std::uint64_t>(work.jobs, kGroups); ++job) others.emplace_back(run);
    run();
  }
  if (failure) std::rethrow_exception(failure);
  return done;
}

Share share_of(std::uint64_t group, std::uint64_t count) {
  const std::uint64_t part = count / kGroups, rest = count % kGroups;
  const std::uint64_t first = group * part + std::min(group, rest);
  return {first, first + part + (group < rest ? 1 : 0)};
}

}  // namespace lorentz::chaos
