// Given queries: a stream of lines, or columns of one scene.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "cli/query_stream.hpp"
#include "src/exchange/columns.hpp"

namespace lorentz::cli {

/// Whether the file's name means that it holds columns.
inline bool is_columns(const std::string& path) {
  return path.ends_with(".npy") || path.ends_with(".csv");
}

/// A query, or a bad line or row in its place.
struct GivenQuery {
  Id id = "null";  ///< for columns without ids, the row number from 0
  std::optional<Query> query;
  double max_time = std::numeric_limits<double>::infinity();
  std::string_view line;   ///< of a stream; valid until the next is read
  bool new_scene = false;  ///< the first in a scene
};

class GivenQueries {
 public:
  /// `scene` holds before the first scene line, and for columns. Throws InputError and FileError.
  GivenQueries(const std::string& path, std::optional<Scene> scene, bool strict);

  /// Reads the next query; false at the end. Reports bad lines and rows on stderr with their place.
  bool next(GivenQuery& given);

  /// The scene of the query. Null before the first.
  const Scene* scene() const { return columns_ ? &*scene_ : stream_->scene(); }
  bool had_bad_input() const { return bad_rows_ > 0 || (stream_ && stream_->had_bad_input()); }
  bool are_columns() const { return columns_ != nullptr; }
  const std::string& name() const { return columns_ ? columns_->name() : stream_->lines().name(); }

 private:
  bool next_line(GivenQuery& given);
  bool next_row(GivenQuery& given);
  void take_row(GivenQuery& given);

  std::optional<Scene> scene_;  // for columns
  std::optional<QueryStream> stream_;
  std::unique_ptr<ColumnReader> columns_;
  QueryRows rows_;
  std::size_t row_ = 0, flaw_ = 0;  // the next ones of rows_
  std::size_t number_ = 0, bad_rows_ = 0;
  bool new_scene_ = true;
};

}  // namespace lorentz::cli
