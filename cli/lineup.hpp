// The engines and files of answers that a command examines together, and where the results go.
#pragma once

#include <list>
#include <optional>
#include <string>
#include <vector>

#include "cli/disagreement_file.hpp"
#include "cli/examination_options.hpp"
#include "cli/logged_answers.hpp"
#include "question/examination.hpp"

namespace lorentz::cli {

/// Questions with exact answers that are asked together.
struct AskedPart {
  std::vector<question::Question> questions;
  std::string set = {};    ///< the golden set that has them, as it was named
  std::string claim = {};  ///< arguments that say by which claim they are judged
};

/// One of those examined: an engine, or a file of answers.
struct LineupEntry {
  LineupEntry(question::Examination its, const FailureFiles& files)
      : examination(std::move(its)), ledger(files) {}

  question::Examination examination;
  std::optional<question::EngineInfo> engine = {};  ///< either this
  LoggedAnswers* logged = nullptr;                  ///< or this: then it is the answerer
  FailureLedger ledger;
  std::vector<std::string> failures = {};  ///< the first new ones, for people
  question::Speed speed = {};
  question::ExaminedRow* row = nullptr;  ///< the current one; null if it never answered and is asked no more

  /// All rows together, and the speed.
  question::Tally total() const;
};

class Lineup {
 public:
  /// Opens the files that the options name. Throws FileError and InputError.
  Lineup(const ExaminationOptions& options, const std::vector<question::EngineInfo>& engines);
  void add(const std::string& name, std::unique_ptr<LoggedAnswers> answers);

  DisagreementFile& disagreements() { return disagreements_; }
  const std::list<LineupEntry>& all() const { return all_; }

  /// Begins a row of this name.
  void begin(const std::string& row);
  /// Asks all of them the questions, which belong to the row: counts the judgements, and records failures and
  /// disagreements.
  void ask(const AskedPart& part);
  /// Skips the logged answers to these questions, so that the files stay in step with the questions.
  void pass_over(const std::vector<question::Question>& questions);
  /// Ends the row. `is_whole`: all its questions were asked, so known failures that did not come are stale.
  void end(bool is_whole);

  /// Measures the speeds of the engines that did not fail, over these questions.
  void race(const std::vector<question::Question>& questions);

  /// Ends the engines and writes the files. Returns the exit status, the largest of those that apply: an engine
  /// failed, the input was bad, there are new failures.
  int finish(bool had_bad_input = false);

 private:
  void take(const question::Judged& judged, const AskedPart& part, LineupEntry& one);

  const ExaminationOptions& options_;
  question::AnswererOptions asking_;
  DisagreementFile disagreements_;
  std::list<LineupEntry> all_;
};

/// A table with a row for each of those examined, and a sentence for each.
std::string table_of(const std::list<LineupEntry>& all);
std::string times_of(const std::list<LineupEntry>& all);  ///< a table of these alone
std::string verdict_of(const question::Tally& tally);

}  // namespace lorentz::cli
