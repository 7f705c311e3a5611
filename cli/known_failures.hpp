// Failures by set and id: which are known, which are new, and a report for systems that run tests.
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

/// A question: the set, the row or the target that asks it, and its id as a golden record.
using RecordKey = std::pair<std::string, std::string>;

/// A file of lines "SET ID", with more behind them as one likes; # begins a comment.
class KnownFailures {
 public:
  /// The lines, and what messages call the file. Throws InputError, naming the line.
  KnownFailures(const std::string& text, const std::string& name);

  /// Of a question that was asked: is its failure new? A known one that did not happen is stale.
  bool is_new(const RecordKey& record, bool failed);
  /// No further question of the set is asked: what is known of it and was not asked is stale.
  void end(const std::string& set);

  const std::vector<RecordKey>& stale() const { return stale_; }
  std::size_t number_met() const { return met_; }

 private:
  std::set<RecordKey> known_, asked_;
  std::vector<RecordKey> stale_;
  std::size_t met_ = 0;
};

/// The XML that JUnit's readers know: a suite for each set, a case for each question.
class JUnit {
 public:
  /// `failure`: what is wrong, or nothing.
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

  /// The failures that the baseline knows. Throws InputError and FileError.
  std::optional<KnownFailures> known() const;

  /// The rows of help; `baseline_help` in place of the usual words on --baseline.
  Option baseline_row(const std::string& baseline_help = "");
  Option write_baseline_row();
  Option junit_row();

  /// The first of the three that is asked for, or nothing.
  std::optional<std::string> first_option() const;
};

/// What counts against an engine, in a word; with `times` wrong times do, with `strict` also ill-posed and undecided
/// answers.
std::optional<std::string> failure_of(const oracle::Judgement& judgement, bool times, bool strict);

/// Takes down the failures of one engine, and writes the files that are asked for.
class FailureLedger {
 public:
  /// Opens the files that are asked for. Throws FileError.
  FailureLedger(const FailureFiles& files, std::optional<KnownFailures> known);

  /// Of a question that was asked; returns whether its failure is new. Blanks in the set's name become hyphens.
  bool take(const std::string& set, const std::string& id, const std::optional<std::string>& failure);
  /// As KnownFailures::end.
  void end(const std::string& set);

  bool has_baseline() const { return known_.has_value(); }
  std::size_t new_failures() const { return new_.size(); }

  /// Says on stderr what is known, new and stale; writes the files.
  void finish(const std::string& engine);

 private:
  std::optional<KnownFailures> known_;
  std::map<RecordKey, std::string> failures_;
  std::vector<std::string> new_;  // lines that tell of them
  std::optional<JUnit> junit_;
  RequestedFile baseline_file_, junit_file_;
};

}  // namespace lorentz::cli
