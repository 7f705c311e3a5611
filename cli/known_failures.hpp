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
#include "files/whole_file.hpp"

namespace lorentz::cli {

/// The key of a question: the set, row or target that asks it, and its id as a golden record.
using RecordKey = std::pair<std::string, std::string>;

/// A file of lines "SET ID", optionally followed by further text. # begins a comment.
class KnownFailures {
 public:
  /// `text`: the lines. `name`: the file's name in messages. Throws InputError with the line's number.
  KnownFailures(const std::string& text, const std::string& name);

  /// For a question that was asked: whether its failure is new. A known failure that did not happen is stale.
  bool is_new(const RecordKey& record, bool failed);
  /// Ends a set. Known failures of it that were not asked are stale.
  void end(const std::string& set);

  const std::vector<RecordKey>& stale() const { return stale_; }
  std::size_t number_met() const { return met_; }

 private:
  std::set<RecordKey> known_, asked_;
  std::vector<RecordKey> stale_;
  std::size_t met_ = 0;
};

/// XML in the format of JUnit: a suite for each set, a case for each question.
class JUnit {
 public:
  /// `failure`: the description of the failure; empty if the question passed.
  void add(const RecordKey& record, const std::optional<std::string>& failure);
  std::string text(const std::string& engine) const;

 private:
  struct Suite {
    std::size_t failures = 0, cases = 0;
    std::string text;
  };
  std::map<std::string, Suite> suites_;
};

/// The options --baseline, --write-baseline and --junit.
struct FailureFiles {
  std::optional<std::string> baseline, write_baseline, junit;

  /// The failures in the baseline. Throws InputError and FileError.
  std::optional<KnownFailures> known() const;

  /// The rows of help. `baseline_help` replaces the usual text for --baseline.
  Option baseline_row(const std::string& baseline_help = "");
  Option write_baseline_row();
  Option junit_row();

  /// The first of the three options that is given, or nothing.
  std::optional<std::string> first_option() const;
};

/// The failure as one word, or nothing. With `times`, wrong times are failures, too; with `strict` also
/// ill-posed and undecided answers.
std::optional<std::string> failure_of(const oracle::Judgement& judgement, bool times, bool strict);

/// Records the failures of one engine, and writes the requested files.
class FailureLedger {
 public:
  /// Opens the requested files. Throws FileError.
  FailureLedger(const FailureFiles& files, std::optional<KnownFailures> known);

  /// Records a question that was asked, and returns whether its failure is new. Blanks in the set's name
  /// become hyphens.
  bool take(const std::string& set, const std::string& id, const std::optional<std::string>& failure);
  /// As KnownFailures::end.
  void end(const std::string& set);

  bool has_baseline() const { return known_.has_value(); }
  std::size_t new_failures() const { return new_.size(); }

  /// Reports known, new and stale failures on stderr, and writes the files.
  void finish(const std::string& engine);

 private:
  std::optional<KnownFailures> known_;
  std::map<RecordKey, std::string> failures_;
  std::vector<std::string> new_;  // the lines that describe them
  std::optional<JUnit> junit_;
  RequestedFile baseline_file_, junit_file_;
};

}  // namespace lorentz::cli
