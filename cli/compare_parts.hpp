// What `lorentz compare` came to, part by part: kept in a store, gone on with, and added up from shards.
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
  std::uint64_t check = 0;                      ///< of the questions
  std::vector<question::Tally> tallies;         ///< of each that is compared
  std::vector<std::vector<std::string>> wrong;  ///< the first wrong answers of each, for people
  std::string disagreements;                    ///< DisagreementFile::take()
};

class ComparedParts {
 public:
  /// Reads the store, if there is one, and those of other shards. `names`: of all that are compared. Throws
  /// InputError and FileError.
  ComparedParts(const CompareOptions& options, const std::vector<std::string>& names);

  /// False if the part is another shard's, or done. Throws InputError if it was done of other questions.
  bool is_to_do(std::uint64_t number, std::uint64_t check) const;
  /// A part that is whole goes to the store.
  void add(ComparedPart part, bool is_whole);

  /// Those that are done, by number.
  const std::map<std::uint64_t, ComparedPart>& all() const { return parts_; }

 private:
  void read(const runs::PieceStore& store, const std::string& name);

  const std::size_t compared_;
  std::uint64_t shard_ = 0, shards_ = 1;
  runs::PieceStore store_;
  std::map<std::uint64_t, ComparedPart> parts_;
};

/// The check of a part's questions.
std::uint64_t check_of(const std::vector<question::Question>& questions);

}  // namespace lorentz::cli
