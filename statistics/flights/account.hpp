// A run of flights: its plan, and its state, which is the finished blocks and their tally. A run is resumed
// from this state in JSON, and the shards of one run are added up from it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <lorentz/scene.hpp>
#include "question/starts/candidates.hpp"
#include "statistics/flights/tally.hpp"

namespace lorentz::flights {

/// The number of consecutive flights in a block; the last block may be shorter.
inline constexpr std::uint64_t kBlock = 1 << 16;

/// Wide enough for flights of 10^4 cells, so that they find no two places of a superposition alike.
inline constexpr std::uint64_t kCellsOfBox = 100'000'000;

/// The flights 0 to count - 1 from the drawn starts of a scene.
struct FlightsPlan {
  Scene scene;  ///< without flaws
  std::string engine = "batch";
  Ensemble from = Ensemble::uniform;
  std::uint64_t seed = 0, count = 0;
  std::uint64_t cells = kCellsOfBox;  ///< of the first lattice, in the box with the starts of a superposition

  std::uint64_t blocks() const;

  /// The whole plan as names and values. Two runs can be added up only if these agree.
  std::vector<std::pair<std::string, std::string>> words() const;
};

/// The exponent of the unit in which times are counted. The unit is near the mean free path of a dilute gas
/// of these obstacles. Answers do not depend on it.
int unit_exponent(const Scene& scene);

/// A set of numbers, stored as ranges with gaps between them. Lookup and insertion take O(log n) for n
/// ranges.
class Ranges {
 public:
  /// Inserts the numbers first to last. Throws std::invalid_argument and changes nothing if last < first or
  /// if the set already has one of them.
  void insert(std::uint64_t first, std::uint64_t last);
  void insert(std::uint64_t number) { insert(number, number); }
  /// Throws std::invalid_argument and changes nothing if the sets have a number in common.
  void add(const Ranges& other);
  bool contains(std::uint64_t number) const { return meets(number, number); }
  std::uint64_t size() const;

  /// Maps the first number of each range to its last.
  const std::map<std::uint64_t, std::uint64_t>& all() const { return ranges_; }

  bool operator==(const Ranges&) const = default;
  friend auto members_of(Ranges& self) { return std::tie(self.ranges_); }

 private:
  bool meets(std::uint64_t first, std::uint64_t last) const;
  void check_apart(std::uint64_t first, std::uint64_t last) const;

  std::map<std::uint64_t, std::uint64_t> ranges_;
};

struct Account {
  Ranges done;  ///< the numbers of the finished blocks
  FlightTally tally;

  /// The account at the beginning of a run of this plan.
  static Account begun(const FlightsPlan& plan);

  /// Adds another account of the same plan. Throws std::invalid_argument if a block is in both.
  void add(const Account& other);

  /// A piece of a store.
  std::string text() const;
  /// The inverse of text(). Throws InputError.
  static Account of(std::string_view text);

  bool operator==(const Account&) const = default;
};

}  // namespace lorentz::flights
