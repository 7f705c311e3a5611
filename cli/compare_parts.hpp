// The results of `lorentz compare`, part by part: kept in a store, resumed, and added up from shards.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cli/compare_questions.hpp"
#include "question/tally.hpp"
#include "runs/piece_store.hpp"

namespace lorentz::cli {

/// One part of the questions, judged.
struct ComparedPart {
  std::uint64_t number = 0;
  std::uint64_t check = 0;                      ///< check_of() the questions
  std::vector<question::Tally> tallies;         ///< of each engine or file
  std::vector<std::vector<std::string>> wrong;  ///< the first wrong answers of each, as text
  std::string disagreements;                    ///< DisagreementFile::take()
};

class ComparedParts {
 public:
  /// Reads the store, if there is one, and the stores of other shards. `names`: the names of all engines and
  /// files that are compared. Throws InputError and FileError.
  ComparedParts(const CompareOptions& options, const std::vector<std::string>& names);

  /// False if the part belongs to another shard or is done. Throws InputError if it was done with other
  /// questions.
  bool is_to_do(std::uint64_t number, std::uint64_t check) const;
  /// Adds a part. A complete part is also written to the store.
  void add(ComparedPart part, bool is_whole);

  /// The finished parts by number.
  const std::map<std::uint64_t, ComparedPart>& all() const { return parts_; }

 private:
  void read(const runs::PieceStore& store, const std::string& name);

  const std::size_t compared_;
  std::uint64_t shard_ = 0, shards_ = 1;
  runs::PieceStore store_;
  std::map<std::uint64_t, ComparedPart> parts_;
};

/// The checksum of a part's questions.
std::uint64_t check_of(const std::vector<question::Question>& questions);

}  // namespace lorentz::cli
