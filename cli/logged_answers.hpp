// An answerer that reads the answers of another program from a file.
#pragma once

#include <memory>
#include <unordered_map>
#include <unordered_set>

#include "question/answerer.hpp"
#include "report/files/unknown_keys.hpp"
#include "src/exchange/columns.hpp"

namespace lorentz::cli {

/// Answers are matched by id; a query without an answer counts as left out. A file in the order of the queries is
/// read as they are asked. Answers that come early are kept until they are needed. Bad lines and repeated ids
/// are reported. Answers without an id (to lines that were not queries) are skipped.
class LoggedAnswers final : public question::Answerer {
 public:
  /// Reads a JSON stream, or columns. Throws FileError, and InputError for columns that do not hold answers.
  LoggedAnswers(const std::string& path, bool strict);
  explicit LoggedAnswers(std::unique_ptr<AnswerReader> columns);

  void ask(const Id& id, const Query& query) override;
  /// Reads the rest and reports answers that did not match. If no answer matched, the input counts as bad; it
  /// is most likely the wrong file.
  void finish() override;
  bool had_bad_input() const { return bad_input_; }
  std::optional<question::OwnTime> own_time() const override { return own_time_; }

 private:
  void enter(const Scene&) override {}
  struct Logged {
    Answer answer;
    std::size_t components = 0;  // of its cell
    std::size_t line = 0;
  };

  bool read(Id& id, Logged& logged);
  bool read_row(Id& id, Logged& logged);
  bool read_line(Id& id, Logged& logged);
  bool find(const Id& id, Logged& logged);
  std::string flaw_of_cell(const Logged& logged) const;
  void complain(std::size_t line, const std::string& what);

  struct AnswerStream {
    LineReader lines;
    ExchangeReader reader;
    KeyCheck keys;
    AnswerStream(const std::string& path, bool strict) : lines(path), keys(path, strict) {}
  };

  std::unique_ptr<AnswerStream> lines_;    // one of these
  std::unique_ptr<AnswerReader> columns_;  //
  std::string name_;
  std::unordered_map<Id, Logged> early_;
  std::unordered_set<Id> ids_;  // all ids that were read
  std::size_t matched_ = 0;
  std::optional<question::OwnTime> own_time_;
  bool is_empty_ = true, is_broken_ = false, bad_input_ = false;
};

}  // namespace lorentz::cli
