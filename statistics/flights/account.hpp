// What a run of flights has come to so far: which of its blocks are done, and their tally. As JSON it is what
// a run is gone on from, and what shards of one run are added up from.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "statistics/flights/tally.hpp"

namespace lorentz::flights {

/// Flights are flown in blocks of so many that follow one another; the last may be shorter.
inline constexpr std::uint64_t kBlock = 1 << 16;

/// A set of numbers, as ranges with gaps between them. Looking up and inserting one of n takes O(log n).
class Ranges {
 public:
  /// The numbers first to last. Throws std::invalid_argument, and changes nothing, if last < first, or the
  /// set has one of them.
  void insert(std::uint64_t first, std::uint64_t last);
  void insert(std::uint64_t number) { insert(number, number); }
  /// Throws std::invalid_argument, and changes nothing, if both have a number in common.
  void add(const Ranges& other);
  bool contains(std::uint64_t number) const { return meets(number, number); }
  std::uint64_t size() const;

  /// The last number of each range by its first.
  const std::map<std::uint64_t, std::uint64_t>& all() const { return ranges_; }

  bool operator==(const Ranges&) const = default;

 private:
  bool meets(std::uint64_t first, std::uint64_t last) const;
  void check_apart(std::uint64_t first, std::uint64_t last) const;

  std::map<std::uint64_t, std::uint64_t> ranges_;
};

struct FlightsPlan;

struct Account {
  Ranges done;  ///< numbers of blocks
  FlightTally tally;

  /// What a run of this plan begins with.
  static Account begun(const FlightsPlan& plan);

  /// Another account of the same plan; throws std::invalid_argument if a block is in both.
  void add(const Account& other);

  /// Throws InputError if no run of this plan can have come to this: a block that the plan has not, counts
  /// that do not add up to the flights of the blocks, sums or extremes that the bins exclude.
  void check(const FlightsPlan& plan) const;

  /// A JSON object.
  std::string text() const;
  /// What text() gave. Throws InputError.
  static Account of(std::string_view text);

  bool operator==(const Account&) const = default;
};

}  // namespace lorentz::flights
