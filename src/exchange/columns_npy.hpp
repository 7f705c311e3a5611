// Queries and answers as arrays of NumPy (docs/formats.md). Private to the formats and the program.
#pragma once

#include <optional>

#include "src/exchange/columns.hpp"
#include "src/exchange/npy_header.hpp"

namespace lorentz {

/// Reads queries: an array of numbers with one row per query, or an array of fields x, v, ..
class NpyQueryReader final : public ColumnReader {
 public:
  /// Opens the file, or standard input for "-", and reads its header. Throws FileError, or InputError if it
  /// is not an array of queries in this number of dimensions.
  NpyQueryReader(const std::string& path, int dimension, const OnUnknownColumn& on_unknown_column);

  bool next(QueryRows& rows, std::size_t most) override;
  const std::string& name() const override { return file_.name(); }

  /// The number of rows that the header promises.
  std::uint64_t promised() const { return promised_; }

  /// True if bytes follow the last row. Waits for them, or for the end.
  bool has_more();

 private:
  /// One number of each buffered row, `stride` bytes apart.
  struct Numbers {
    const char* first;
    std::size_t stride;
  };

  void understand_numbers();
  void understand_fields(const OnUnknownColumn& on_unknown_column);
  const NpyField* field(const std::string& name, bool needed) const;
  void check_number(const NpyField& field, bool is_vector, bool is_real) const;
  [[noreturn]] void refuse() const;

  std::size_t fill(std::size_t most);
  std::size_t fill_rows(std::size_t most);
  std::size_t fill_columns(std::size_t most);
  std::size_t read_column(std::size_t column, std::size_t most, char* bytes);
  Numbers numbers(const NpyField& field, int component) const;
  void append_rows(QueryRows& rows, std::size_t count) const;
  void append_from(QueryRows& rows, std::size_t count) const;

  InputFile file_;
  NpyHeader header_;
  const int dimension_;
  NpyField x_, v_;
  std::optional<NpyField> max_time_, from_lattice_, from_atom_, from_cell_;
  bool by_columns_ = false;  // in Fortran order
  std::size_t row_bytes_ = 0;
  std::uint64_t promised_ = 0, done_ = 0;

  std::vector<char> buffer_;  // rows; or columns, `held_` numbers each
  std::size_t begin_ = 0, end_ = 0, held_ = 0;
  std::optional<std::uint64_t> place_;  // of the first number, for columns in a file
  std::vector<char> all_;               // for columns in a pipe
};

/// Reads answers: an array of fields outcome, lattice, .., as append_npy_answers writes them, in any order
/// and of any types that hold them. Other fields are ignored.
class NpyAnswerReader final : public AnswerReader {
 public:
  /// Like NpyQueryReader.
  NpyAnswerReader(const std::string& path, int dimension);

  bool next(Answer& answer, Id& id) override;
  const std::string& name() const override { return file_.name(); }

 private:
  const NpyField& field(const char* name, std::size_t numbers) const;
  std::int64_t integer(const NpyField& field, std::size_t component = 0) const;
  [[noreturn]] void refuse(const std::string& what) const;

  InputFile file_;
  const NpyHeader header_;
  const int dimension_;
  NpyField outcome_, lattice_, atom_, cell_, time_;
  std::uint64_t done_ = 0;
  std::vector<char> row_;
};

/// All fields that queries can have.
std::vector<std::string> npy_query_fields();

/// The header of an array of `count` queries without limits: an array of numbers, or of fields if the queries
/// leave obstacles.
std::string npy_query_header(std::uint64_t count, int dimension, bool with_from);

/// Appends the queries as elements of this array.
void append_npy_queries(std::string& out, const QueryRows& queries, int dimension);

/// The header of an array of `count` answers.
std::string npy_answer_header(std::uint64_t count, int dimension);

/// Appends the answers as elements of this array. There must be no large cells.
void append_npy_answers(std::string& out, const AnswerRows& answers);

}  // namespace lorentz
