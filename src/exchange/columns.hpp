// Queries and answers in columns: what the formats besides JSON read and write. Private to the formats, and
// to those in this program who fly columns.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/exchange.hpp>
#include <lorentz/query.hpp>

namespace lorentz {

/// Queries of one scene, a column each component. In 2D the third columns of vectors are empty.
struct QueryRows {
  /// A row that means no query, and why; what stands in its columns means nothing.
  struct Flaw {
    std::size_t row;
    std::string message;
  };

  std::size_t count = 0;
  std::array<std::vector<double>, 3> x, v;
  std::vector<double> max_time;  ///< empty: no query has a limit

  /// The obstacle that a query leaves; a lattice below 0: none. Empty: no query leaves one.
  std::vector<std::int32_t> from_lattice, from_atom;
  std::array<std::vector<std::int64_t>, 3> from_cell;
  /// Those whose cells 64 bits do not hold, by row; the columns say that these rows leave none.
  std::vector<std::pair<std::size_t, ObstacleId>> large_from;

  std::vector<std::string> id;  ///< as text; empty: there are none

  std::vector<Flaw> flaws;         ///< in the order of the rows
  std::uint64_t first = 0;         ///< which row of the file the first is, from 0
  std::vector<std::size_t> lines;  ///< in which line each stands, if the file has lines

  /// Removes all rows; what is allocated stays.
  void clear();
  Query query(std::size_t i, int dimension) const;
};

/// The cells of answers: a column each coordinate, one behind the other, as an array in the order of Fortran.
class CellColumns {
 public:
  void resize(std::size_t rows, int dimension) {
    rows_ = rows;
    all_.resize(rows * static_cast<std::size_t>(dimension));
  }
  std::int64_t* operator[](int k) { return all_.data() + static_cast<std::size_t>(k) * rows_; }
  const std::int64_t* operator[](int k) const { return all_.data() + static_cast<std::size_t>(k) * rows_; }
  std::size_t rows() const { return rows_; }  ///< from column to column

 private:
  std::size_t rows_ = 0;
  std::vector<std::int64_t> all_;
};

/// Answers in columns, as long as the queries'. What an outcome does not have is 0, the time NaN.
struct AnswerRows {
  /// Why a row is an `error`.
  struct Reason {
    std::size_t row;
    std::string message;
    bool unsupported;  ///< no fault of the query
  };
  /// What `stage` says besides the numbers of lorentz::Stage.
  static constexpr std::uint8_t kExactStage = 3, kNoStage = 255;

  std::size_t count = 0;
  int dimension = 0;
  std::vector<Outcome> outcome;
  std::vector<std::uint8_t> stage;
  std::unique_ptr<bool[]> time_is_rounded;
  std::vector<std::int32_t> lattice, atom;
  CellColumns cell;  ///< as many columns as dimensions
  std::vector<double> time;

  std::vector<std::pair<std::size_t, Cell>> large_cells;  ///< those that 64 bits do not hold, by row
  std::vector<Reason> reasons;

  /// Room for so many rows, whose columns say nothing yet; without large cells and reasons.
  void resize(std::size_t rows, int dimensions);
  /// Makes a row an outcome without an obstacle or a time.
  void set_plain(std::size_t i, Outcome plain);
  void set_error(std::size_t i, std::string message, bool unsupported);
  void set(std::size_t i, const Answer& answer, std::uint8_t of_stage, bool rounded);
  /// Answers with cells that 64 bits do not hold become errors: for a format that has no more.
  void refuse_large_cells();
};

/// Reads queries in columns, part by part.
class ColumnReader {
 public:
  virtual ~ColumnReader() = default;

  /// Up to about `most` more rows behind those that are there; false if there are none. Throws InputError,
  /// also behind the last good row of a broken file, and FileError.
  virtual bool next(QueryRows& rows, std::size_t most) = 0;

  /// Called when the input pauses: the place to answer the rows that are there, and clear them.
  void before_waiting(std::function<void()> callback) { before_waiting_ = std::move(callback); }

  /// What the input is called in messages.
  virtual const std::string& name() const = 0;

 protected:
  std::function<void()> before_waiting_ = [] {};
};

/// Reads answers in columns, one after the other.
class AnswerReader {
 public:
  virtual ~AnswerReader() = default;

  /// The next row; false at the end. `id` is the row's id, or its number from 0 if there are no ids. Throws
  /// InputError, with the place, for a row that is not an answer, and FileError.
  virtual bool next(Answer& answer, Id& id) = 0;
  virtual const std::string& name() const = 0;
};

/// Told of each column that queries do not have, and where it stands. What it throws ends the reading.
using OnUnknownColumn = std::function<void(const std::string& place, const std::string& column)>;

}  // namespace lorentz
