// The golden sets by name, their contents, and their files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fuzz/families/family.hpp"
#include "judge/golden/record.hpp"

namespace lorentz::golden {

/// One question of a set. `query` is missing if the question is invalid; then there is only the text.
struct SetQuestion {
  Scene scene;
  std::string text;
  std::optional<Query> query;
  std::vector<std::string> tags;
  std::string source_id = {};  ///< of a record
};

struct Set {
  std::string name;    ///< in binary32 the family's name followed by "-binary32"
  std::string family;  ///< family of cases; for bad-queries the set's own name
  std::string description;
  std::vector<cases::Tag> tags;
  NumberFormat precision;  ///< of the numbers of scenes and queries
  std::uint64_t count;     ///< default number of records
  std::uint64_t most;      ///< largest number of records
  bool is_committed;       ///< data/golden contains the set, with `count` records

  /// Determined by (set, seed, index). Consecutive cases share a scene: 32 in binary64, 8 in binary32.
  SetQuestion question(std::uint64_t seed, std::uint64_t index) const;
};

/// All sets: one of each family of cases, and bad-queries; then one of each family in binary32.
const std::vector<Set>& sets();

/// The set of this family in this precision; otherwise the set of this name in any precision; null if no set
/// fits.
const Set* set_named(std::string_view name, NumberFormat precision = NumberFormat::binary64);

/// The committed sets: every *.ndjson in data/golden, by name. Empty if the folder does not exist.
std::vector<std::string> committed_sets();

/// The file of a set, given a file (or a folder) or the name of a committed set. Throws InputError for a name that no
/// set has, listing the sets, and FileError for a file that is not there.
std::string find_set(const std::string& name_or_file);

/// The files of these sets; for a folder every *.ndjson in it; all committed sets if no name is given. Throws
/// FileError if there are none.
std::vector<std::string> find_sets(const std::vector<std::string>& names_or_files);

}  // namespace lorentz::golden
