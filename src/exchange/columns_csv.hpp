// Queries and answers as CSV: a line of names, then one line per query (docs/formats.md). Private to the
// formats and the program.
#pragma once

#include <limits>

#include "src/exchange/csv_table.hpp"

namespace lorentz {

/// Reads queries. A bad line becomes a row with a flaw. Where a lattice has fewer vectors than dimensions,
/// the last columns of its cells are empty (or 0).
class CsvQueryReader final : public ColumnReader {
 public:
  /// Opens the file, or standard input for "-", and reads its first line. Throws FileError, or InputError if
  /// the columns are not those of queries with this number of components.
  CsvQueryReader(const std::string& path, const Components& components,
                 const OnUnknownColumn& on_unknown_column);

  bool next(QueryRows& rows, std::size_t most) override;
  const std::string& name() const override { return table_.lines().name(); }
  bool has_ids() const { return id_ != CsvTable::kNone; }

 private:
  static constexpr std::size_t kNone = CsvTable::kNone;
  /// The content of a line, before it is checked.
  struct Row {
    std::array<double, 3> x{}, v{};
    double max_time = std::numeric_limits<double>::infinity();
    std::int32_t from_lattice = -1, from_atom = 0;
    std::array<std::int64_t, 3> from_cell{};
  };

  void understand(const CsvTable& table);
  void read_row(QueryRows& rows);
  Row row_of() const;
  void read_from(Row& row) const;
  void push_back(const Row& row, QueryRows& rows) const;

  const Components components_;
  const int dimension_;
  std::array<std::size_t, 3> x_{}, v_{}, from_cell_{};
  std::size_t max_time_ = kNone, from_lattice_ = kNone, from_atom_ = kNone, id_ = kNone;
  CsvTable table_;
};

/// Reads answers: the columns that append_csv_answers writes, in any order.
class CsvAnswerReader final : public AnswerReader {
 public:
  /// Like CsvQueryReader; unknown columns are ignored.
  CsvAnswerReader(const std::string& path, const Components& components);

  bool next(Answer& answer, Id& id) override;
  const std::string& name() const override { return table_.lines().name(); }

 private:
  void understand(const CsvTable& table);
  Answer answer_of() const;

  const Components components_;
  const int dimension_;
  std::size_t outcome_ = 0, lattice_ = 0, atom_ = 0, time_ = 0, id_ = CsvTable::kNone;
  std::array<std::size_t, 3> cell_{};
  std::uint64_t done_ = 0;
  CsvTable table_;
};

/// All columns that queries and answers can have.
std::vector<std::string> csv_query_columns(int dimension);
std::vector<std::string> csv_answer_columns(int dimension);

/// Append the line of names for queries without ids and limits; and queries, one line each.
void append_csv_query_names(std::string& out, int dimension, bool with_from);
void append_csv_queries(std::string& out, const QueryRows& queries, const Components& components);

/// Appends the line of names for answers.
void append_csv_names(std::string& out, int dimension, bool with_ids);

/// Appends answers, one line each; the ids are those of the queries.
void append_csv_answers(std::string& out, const QueryRows& queries, const AnswerRows& answers,
                        const Components& components, bool with_ids);

}  // namespace lorentz
