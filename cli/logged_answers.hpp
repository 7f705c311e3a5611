// Answers that some program wrote to a file, as an answerer.
#pragma once

#include <memory>
#include <unordered_map>
#include <unordered_set>

#include "files/unknown_keys.hpp"
#include "question/answerer.hpp"
#include "src/exchange/columns.hpp"

namespace lorentz::cli {

/// Answers are matched by id; a query without an answer is `not_asked`. A file in the order of the queries is
/// read as they are asked; answers that come early are kept until then. Bad lines, and ids that come twice, are
/// complained of; answers without an id (to lines that were no queries) are passed over.
class LoggedAnswers final : public question::Answerer {
 public:
  /// A stream in JSON; or columns. Throws FileError, and InputError for columns that are not of answers.
  LoggedAnswers(const std::string& path, UnknownKeys unknown);
  explicit LoggedAnswers(std::unique_ptr<AnswerReader> columns);

  void ask(const Id& id, const Query& query) override;
  /// Reads the rest, and says what did not match; nothing matched at all is bad input, the wrong file most
  /// likely.
  void finish() override;
  bool had_bad_input() const { return bad_input_; }

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
    AnswerStream(const std::string& path, UnknownKeys unknown) : lines(path), keys(path, unknown) {}
  };

  std::unique_ptr<AnswerStream> lines_;    // one of these
  std::unique_ptr<AnswerReader> columns_;  //
  std::string name_;
  std::unordered_map<Id, Logged> early_;
  std::unordered_set<Id> ids_;  // of all that were read
  std::size_t matched_ = 0;
  bool is_empty_ = true, is_broken_ = false, bad_input_ = false;
};

}  // namespace lorentz::cli
