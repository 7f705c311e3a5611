// Failures by set and id: known ones, new ones, and a report for test systems.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <lorentz/verdict.hpp>
#include "cli/command.hpp"
#include "question/counts.hpp"
#include "report/files/whole_file.hpp"

namespace lorentz::cli {

/// The key of a question: the set, row or target that asks it, and its id as a golden record.
using RecordKey = std::pair<std::string, std::string>;

/// The options --baseline and --junit.
struct FailureFiles {
  std::optional<std::string> baseline, junit;

  Option baseline_row();
  Option junit_row();

  /// The first of the options that is given, or nothing.
  std::optional<std::string> first_option() const;
};

/// The failure as one word, or nothing. With `times`, wrong times are failures, too; with `strict` also
/// ill-posed and undecided answers.
std::optional<std::string> failure_of(const oracle::Judgement& judgement, bool times, bool strict);

/// Records the failures of one engine. The baseline is a list of known failures, lines "SET ID", optionally
/// followed by further text; # begins a comment. If there is no such file yet, it is written with the failures of
/// this run. The report is XML in the format of JUnit with a suite for each set and a case for each question; a
/// failure that is known is skipped there, with the baseline's line.
class FailureLedger {
 public:
  /// Reads or opens the files. Throws FileError, and InputError with the number of a bad line.
  explicit FailureLedger(const FailureFiles& files);

  /// True if a file is about each question; otherwise ids have no effect.
  bool needs_ids() const { return known_ || makes_junit_ || baseline_file_; }

  /// Records a question that was asked, and returns whether its failure is new. A known failure that did not
  /// happen is stale. Blanks in the set's name become hyphens.
  bool take(const std::string& set, const std::string& id, const std::optional<std::string>& failure);
  /// Ends a set. Known failures of it that were not asked are stale.
  void end(const std::string& set);

  /// The number of failures of a run with these counts; with a baseline, of new ones only.
  std::size_t failures(const question::Counts& counts, bool times, bool strict) const;

  /// Reports known, new and stale failures on stderr, and writes the files.
  void finish(const std::string& engine);

 private:
  struct Suite {
    std::size_t failures = 0, skipped = 0, cases = 0;
    std::string text;
  };

  void add_case(const RecordKey& record, const std::optional<std::string>& failure, bool is_known);
  std::string junit_text(const std::string& engine) const;

  const bool makes_junit_;
  const std::string baseline_;                             // its name, or ""
  std::optional<std::map<RecordKey, std::size_t>> known_;  // and their lines
  std::set<RecordKey> asked_;                              // of the known ones
  std::vector<RecordKey> stale_;
  std::size_t met_ = 0;  // known ones that failed again
  std::map<RecordKey, std::string> failures_;
  std::size_t number_of_new_ = 0;
  std::vector<std::string> new_;  // the lines that describe them, if others are known
  std::map<std::string, Suite> suites_;
  std::optional<RequestedFile> baseline_file_;  // to be written
  RequestedFile junit_file_;
};

}  // namespace lorentz::cli
