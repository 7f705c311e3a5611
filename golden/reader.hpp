// Reads golden sets, line by line.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "golden/record.hpp"

namespace lorentz::golden {

/// A record with its place and its query.
struct ReadRecord {
  Record record;
  std::size_t line = 0;
  std::optional<Query> query;  ///< nothing: the question is none; `flaw` says why
  std::string flaw;
  std::string text;  ///< the line
};

class Reader {
 public:
  /// Opens a set and reads its header. Throws FileError, or InputError naming the line.
  explicit Reader(const std::string& path);
  /// The same of a set in memory, which messages call `name`.
  Reader(std::string_view text, std::string name);
  ~Reader();

  const std::string& path() const;
  const Header& header() const;

  /// The next record; false at the end. Throws InputError, naming the line, for what is no record.
  bool next(ReadRecord& record);

  /// The scene of the record, and its line without the line end. A new scene has another number.
  const Scene& scene() const;
  const std::string& scene_line() const;
  std::size_t scene_number() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lorentz::golden
