// A run of flights: its plan, and its state, which is the finished blocks and their tally. A run is resumed
// from this state in JSON, and the ranks of one run are added up from it.
#pragma once

#include <boost/icl/closed_interval.hpp>
#include <boost/icl/interval_set.hpp>

#include <cstdint>
#include <string>
#include <string_view>
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

/// A set of numbers of blocks.
using Blocks = boost::icl::interval_set<std::uint64_t, std::less, boost::icl::closed_interval<std::uint64_t>>;

struct Account {
  Blocks done;  ///< the finished ones
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
