// Queries and answers as CSV: a line of names, then a line a query (docs/formats.md). Private to the formats
// and the program.
#pragma once

#include <deque>

#include <lorentz/line_reader.hpp>
#include "src/exchange/columns.hpp"

namespace lorentz {

/// Reads queries. A bad line becomes a row with a flaw.
class CsvQueryReader final : public ColumnReader {
 public:
  /// Opens the file, or standard input for "-", and reads its first line. Throws FileError, or InputError if
  /// the columns are not those of queries in so many dimensions.
  CsvQueryReader(const std::string& path, int dimension, const OnUnknownColumn& on_unknown_column);

  bool next(QueryRows& rows, std::size_t most) override;
  const std::string& name() const override { return lines_.name(); }
  bool has_ids() const { return id_ != kNone; }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  /// What a line says, before it is known to be good.
  struct Row {
    std::array<double, 3> x{}, v{};
    double max_time;
    std::int32_t from_lattice = -1, from_atom = 0;
    std::array<std::int64_t, 3> from_cell{};
  };

  std::vector<std::string> read_names();
  std::size_t take(const std::string& column);
  std::size_t need(const std::string& column, const char* why);
  void split(std::string_view text);
  std::size_t split_quoted(std::string_view text, std::size_t begin);
  void read_row(const LineReader::Line& line, QueryRows& rows);
  Row row_of(const LineReader::Line& line);
  double number(std::size_t column) const;
  std::int64_t integer(std::size_t column) const;
  void read_from(Row& row) const;
  void push_back(const Row& row, QueryRows& rows) const;
  [[noreturn]] void refuse(std::size_t column, const char* why) const;

  LineReader lines_;
  const int dimension_;
  std::vector<std::string> names_;  // of the columns
  std::array<std::size_t, 3> x_{}, v_{}, from_cell_{};
  std::size_t max_time_ = kNone, from_lattice_ = kNone, from_atom_ = kNone, id_ = kNone;

  std::vector<std::string_view> fields_;  // of the line that is read, without spaces and quotes
  std::deque<std::string> unquoted_;      // those that are not, as they are, a part of it
};

/// All columns that queries can have.
std::vector<std::string> csv_query_columns(int dimension);

/// The line of names of queries, without ids and limits; and queries, a line each.
void append_csv_query_names(std::string& out, int dimension, bool with_from);
void append_csv_queries(std::string& out, const QueryRows& queries, int dimension);

/// The line of names of answers.
void append_csv_names(std::string& out, int dimension, bool with_ids);

/// Answers, a line each; the ids are those of the queries.
void append_csv_answers(std::string& out, const QueryRows& queries, const AnswerRows& answers, bool with_ids);

}  // namespace lorentz
