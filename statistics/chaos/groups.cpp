#include "statistics/chaos/groups.hpp"

#include <algorithm>
#include <exception>
#include <mutex>

#include <lorentz/errors.hpp>
#include "src/exchange/json_piece.hpp"
#include "src/problem/threads.hpp"

namespace lorentz::chaos {

static auto members_of(Sums& self) {
  return std::tie(self.values, self.particles, self.collisions, self.stopped);
}

std::string text_of(std::uint64_t group, const Sums& sums) {
  return json::piece_of(std::tie(group, sums));
}

Sums sums_in(std::string_view text, std::uint64_t& group) {
  Sums sums;
  json::read_piece(text, std::tie(group, sums));
  return sums;
}

namespace {

using AllSums = std::vector<std::optional<Sums>>;

AllSums kept_by(const Work& work) {
  AllSums all(kGroups);
  if (!work.each_kept) return all;
  work.each_kept([&](const std::string& text) {
    std::uint64_t group = 0;
    Sums sums = sums_in(text, group);
    all.at(group) = std::move(sums);
  });
  return all;
}

}  // namespace

AllSums for_each_group(const Work& work, const std::function<Sums(std::uint64_t)>& act) {
  AllSums all = kept_by(work);
  std::uint64_t next = 0, finished = 0;
  for (const auto& sums : all) finished += sums.has_value();
  std::exception_ptr failure;
  std::mutex mutex;
  const auto take = [&](std::uint64_t& group) {
    const std::lock_guard lock(mutex);
    while (next < kGroups && all[next]) ++next;
    if (failure || work.is_stopped() || next == kGroups) return false;
    group = next++;
    return true;
  };
  const auto hand_in = [&](std::uint64_t group, Sums sums) {
    const std::lock_guard lock(mutex);
    if (work.is_stopped()) return;  // the group may be incomplete
    if (work.keep) work.keep(text_of(group, sums));
    all[group] = std::move(sums);
    if (work.on_progress) work.on_progress(++finished);
  };
  const auto run = [&] {
    try {
      for (std::uint64_t group; take(group);) hand_in(group, act(group));
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
    }
  };
  {
    const auto others = threads_of(std::min<std::uint64_t>(work.jobs, kGroups) - 1, run);
    run();
  }
  if (failure) std::rethrow_exception(failure);
  return all;
}

std::uint64_t first_of(std::uint64_t group, std::uint64_t count) {
  return group * (count / kGroups) + std::min(group, count % kGroups);
}

std::string remark_on_end(bool is_whole) {
  return is_whole ? "" : "interrupted: only the parts that were done by then\n";
}

}  // namespace lorentz::chaos
