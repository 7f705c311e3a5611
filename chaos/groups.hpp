// Runs of particles are cut into groups, always the same ones: what each comes to does not depend on the
// threads, and groups are the independent parts that errors are told from.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

namespace lorentz::chaos {

inline constexpr std::uint64_t kGroups = 64;

/// How a run is done; none of it changes what comes out.
struct Work {
  unsigned jobs = 1;
  const std::atomic<bool>* stop = nullptr;              ///< stop when this becomes true
  std::function<void(std::uint64_t)> on_progress = {};  ///< so many groups are done; one thread at a time

  bool is_stopped() const { return stop && *stop; }
};

/// Calls `act(group)` for the groups 0 to kGroups - 1 on threads, until all are done or the work is stopped.
/// Which are done. Throws what one of them threw.
std::vector<bool> for_each_group(const Work& work, const std::function<void(std::uint64_t)>& act);

/// [first, last) of `count` things for a group.
struct Share {
  std::uint64_t first, last;
};
Share share_of(std::uint64_t group, std::uint64_t count);

}  // namespace lorentz::chaos
