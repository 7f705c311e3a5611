// Failures that are known, by set and id; and a report for systems that run tests.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace lorentz::cli {

/// A record of a set.
using RecordKey = std::pair<std::string, std::string>;

/// A file of lines "SET ID", with more behind them as one likes; # begins a comment.
class KnownFailures {
 public:
  /// Throws InputError, naming the line, and FileError.
  explicit KnownFailures(const std::string& path);

  /// Of a record that was asked: is its failure new? A known one that did not happen is stale.
  bool is_new(const RecordKey& record, bool failed);
  const std::vector<RecordKey>& stale() const { return stale_; }
  std::size_t number_met() const { return met_; }

 private:
  std::set<RecordKey> known_;
  std::vector<RecordKey> stale_;
  std::size_t met_ = 0;
};

/// The text of such a file: of each failure its set, id and verdict.
std::string known_failures_text(const std::map<RecordKey, std::string>& failures);

/// The XML that JUnit's readers know: a suite for each set, a case for each record.
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

}  // namespace lorentz::cli
