// Runs of particles are cut into groups, always the same ones: what each comes to does not depend on the
// threads, and groups are the independent parts that errors are told from.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lorentz::chaos {

inline constexpr std::uint64_t kGroups = 64;

/// What the particles of a group came to.
struct Sums {
  std::vector<double> values;  ///< which ones, the run knows
  std::uint64_t particles = 0, collisions = 0, stopped = 0;

  bool operator==(const Sums&) const = default;
};

/// A group's number and sums as a JSON object, to the bit; and back. Throws InputError.
std::string text_of(std::uint64_t group, const Sums& sums);
Sums sums_in(std::string_view text, std::uint64_t& group);

/// Groups that are kept from one run to the next, as text_of() writes them.
struct KeptGroups {
  std::function<void(const std::function<void(const std::string&)>& read)>
      each;                                     ///< reads all that are there
  std::function<void(const std::string&)> add;  ///< one thread at a time
};

/// How a run is done; none of it changes what comes out.
struct Work {
  unsigned jobs = 1;
  const std::atomic<bool>* stop = nullptr;              ///< stop when this becomes true
  std::function<void(std::uint64_t)> on_progress = {};  ///< so many groups are done; one thread at a time
  std::optional<KeptGroups> kept = {};

  bool is_stopped() const { return stop && *stop; }
};

/// The sums of the groups 0 to kGroups - 1 that were kept, or that `act(group)` came to on threads before all
/// were done or the work was stopped. Throws what one of them threw; InputError if `is_possible(group, sums)`
/// is false for a kept one.
std::vector<std::optional<Sums>> for_each_group(
    const Work& work, const std::function<Sums(std::uint64_t)>& act,
    const std::function<bool(std::uint64_t, const Sums&)>& is_possible);

/// What a result that is not whole says of itself, or nothing.
std::string remark_on_end(bool is_whole);

/// [first, last) of `count` things for a group.
struct GroupShare {
  std::uint64_t first, last;
};
GroupShare share_of(std::uint64_t group, std::uint64_t count);

}  // namespace lorentz::chaos
