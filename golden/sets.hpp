// The golden sets by name: what each is made of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/families/family.hpp"
#include "golden/record.hpp"

namespace lorentz::golden {

/// One question of a set. `query` is missing if it is invalid: then the text is all there is.
struct SetQuestion {
  Scene scene;
  std::string text;
  std::optional<Query> query;
  std::vector<std::string> tags;
  std::string source_id = {};  ///< of a record
};

struct Set {
  std::string name;    ///< of binary32 the family's with "-binary32" behind it
  std::string family;  ///< of cases; of bad-queries its name
  std::string description;
  std::vector<cases::Tag> tags;
  NumberFormat precision;  ///< of the numbers of scenes and queries
  std::uint64_t count;     ///< how many records are made if nobody says how many
  std::uint64_t most;      ///< how many there are
  bool is_committed;       ///< data/golden holds so many of them

  /// Follows from (set, seed, index). Cases in a row share a scene: 32 in binary64, 8 in binary32.
  SetQuestion question(std::uint64_t seed, std::uint64_t index) const;
};

/// All sets: one of each family of cases, and bad-queries; then one of each family in binary32.
const std::vector<Set>& sets();

/// The set of this family in the precision; or else the one of this name, whatever its precision. Null if there
/// is none.
const Set* set_named(std::string_view name, NumberFormat precision = NumberFormat::binary64);

}  // namespace lorentz::golden
