// Reads golden sets, line by line.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <lorentz/exchange.hpp>
#include "judge/golden/record.hpp"
#include "question/question.hpp"

namespace lorentz::golden {

/// A record with its place and its query.
struct ReadRecord {
  Record record;
  std::size_t line = 0;
  std::optional<Query> query;  ///< nothing: the question is invalid; `flaw` says why
  std::string flaw;
  std::string text;  ///< the line
};

class Reader {
 public:
  /// Opens a set and reads its header. The listener gets each key that no set has. Throws FileError, or InputError
  /// with the line.
  explicit Reader(const std::string& path, OnUnknownKey on_unknown_key = {});
  ~Reader();

  const std::string& path() const;
  const Header& header() const;

  /// Reads the next record; false at the end. Throws InputError with the line for an invalid record.
  bool next(ReadRecord& record);

  /// The scene of the record, and its line without the line end. Each new scene has another number.
  const Scene& scene() const;
  const std::string& scene_line() const;
  std::size_t scene_number() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A source of the next records, judged by the claim; `where` is the record's id. Throws as the reader does.
/// The reader must outlast the source. Margins are those of the records if the claim's precision is the
/// set's; otherwise they are recomputed.
question::Source questions_of(Reader& reader, const Claim& claim = {});

}  // namespace lorentz::golden
