// The golden sets by name: what each is made of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/families/family.hpp"
#include "golden/record.hpp"

namespace lorentz::golden {

/// One question of a set. `query` is missing if it is none: then the text is all there is.
struct SetQuestion {
  Scene scene;
  std::string text;
  std::optional<Query> query;
  std::vector<std::string> tags;
};

struct Set {
  std::string name, description;
  std::vector<cases::Tag> tags;
  std::uint64_t committed;  ///< how many records of it data/golden holds
  std::uint64_t most;       ///< how many there are

  /// Follows from (set, seed, index).
  SetQuestion question(std::uint64_t seed, std::uint64_t index) const;
};

/// All sets: one of each family of cases, and bad-queries.
const std::vector<Set>& sets();

/// Null if there is none of that name.
const Set* set_named(std::string_view name);

}  // namespace lorentz::golden
