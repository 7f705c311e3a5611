// What a run of flights has come to so far: which of its blocks are done, and their tally. As a line of JSON
// it is what a run is gone on from, and what shards of one run are added up from.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "flights/tally.hpp"

namespace lorentz::flights {

/// Flights are flown in blocks of so many that follow one another; the last may be shorter.
inline constexpr std::uint64_t kBlock = 1 << 16;

/// A set of numbers, as ranges [first, last] with gaps between them, in order.
class Ranges {
 public:
  /// Throws std::invalid_argument, and changes nothing, if it is there, or they have a number in common.
  void insert(std::uint64_t number);
  void add(const Ranges& other);
  bool contains(std::uint64_t number) const;
  std::uint64_t size() const;

  /// Appends a range behind all others; throws std::invalid_argument if it is not behind them.
  void append(std::uint64_t first, std::uint64_t last);
  const std::vector<std::pair<std::uint64_t, std::uint64_t>>& all() const { return ranges_; }

  bool operator==(const Ranges&) const = default;

 private:
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges_;
};

struct Account {
  std::string plan;  ///< the text of the plan that this belongs to (Plan::text)
  Ranges done;       ///< numbers of blocks
  Tally tally;

  /// Of the same plan; throws std::invalid_argument for another one, or blocks that are in both.
  void add(const Account& other);

  /// One line of JSON.
  std::string text() const;
  /// Throws InputError.
  static Account of(std::string_view text);

  bool operator==(const Account&) const = default;
};

}  // namespace lorentz::flights
