// A run of particles is divided into groups, always in the same way, so that the sums of a group do not
// depend on the number of threads. Errors are estimated from the groups, which are independent.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lorentz::chaos {

inline constexpr std::uint64_t kGroups = 64;

/// Sums over the particles of a group.
struct Sums {
  std::vector<double> values;  ///< their meaning is defined by the run
  std::uint64_t particles = 0, collisions = 0, stopped = 0;

  bool operator==(const Sums&) const = default;
};

/// A group's number and sums as a piece of a store, and the inverse. Throws InputError.
std::string text_of(std::uint64_t group, const Sums& sums);
Sums sums_in(std::string_view text, std::uint64_t& group);

/// How a run is executed. None of these options changes the result.
struct Work {
  unsigned jobs = 1;
  const std::atomic<bool>* stop = nullptr;              ///< stop when this becomes true
  std::function<void(std::uint64_t)> on_progress = {};  ///< number of finished groups; one thread at a time
  /// Groups that are stored from one run to the next, as written by text_of(): reads all, and adds one (by one
  /// thread at a time). Empty: nothing is stored.
  std::function<void(const std::function<void(const std::string&)>& read)> each_kept = {};
  std::function<void(const std::string&)> keep = {};

  bool is_stopped() const { return stop && *stop; }
};

/// The sums of the groups 0 to kGroups - 1: the stored ones, and those that `act(group)` computes on threads
/// until all are done or the work is stopped. Rethrows an exception of `act`.
std::vector<std::optional<Sums>> for_each_group(const Work& work,
                                                const std::function<Sums(std::uint64_t)>& act);

/// The remark for an incomplete result; empty if it is complete.
std::string remark_on_end(bool is_whole);

/// The first of the items of `count` that belong to a group; they end where those of the next begin.
std::uint64_t first_of(std::uint64_t group, std::uint64_t count);

/// A number and its standard error.
struct Estimate {
  double value = 0, error = 0;
};

/// The mean of equal parts, and the standard deviation of that mean. With one part the error is infinite.
inline Estimate estimate_of(const std::vector<double>& parts) {
  const auto n = static_cast<double>(parts.size());
  Estimate estimate;
  for (const double part : parts) estimate.value += part / n;
  double sum = 0;
  for (const double part : parts) sum += (part - estimate.value) * (part - estimate.value);
  estimate.error = std::sqrt(sum / (n - 1) / n);
  if (!(n > 1)) estimate.error = HUGE_VAL;
  return estimate;
}

/// The ratio of two means, each over the same number of equal parts. The error is that of the deviations of
/// the parts from this ratio, to first order.
inline Estimate estimate_of_ratio(const std::vector<double>& above, const std::vector<double>& below) {
  const double mean = estimate_of(below).value, ratio = estimate_of(above).value / mean;
  std::vector<double> parts;
  for (std::size_t k = 0; k < above.size(); ++k) parts.push_back((above[k] - ratio * below[k]) / mean);
  return {ratio, estimate_of(parts).error};
}

}  // namespace lorentz::chaos
