// Queries and answers in columns, which the formats other than JSON read and write. Private to the formats,
// and to the parts of the program that fly columns.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/exchange.hpp>
#include <lorentz/query.hpp>

namespace lorentz {

/// A row that is not a valid query, or an answer that is an `error`, and why.
struct RowFlaw {
  std::size_t row;
  std::string message;
  bool unsupported = false;  ///< no fault of the query
};

/// Queries of one scene, with one column per component. In 2D the third columns of vectors are empty.
struct QueryRows {
  std::size_t count = 0;
  std::array<std::vector<double>, 3> x, v;
  std::vector<double> max_time;  ///< empty: no query has a limit

  /// The obstacle that a query leaves. A lattice below 0 means that it leaves none. If the columns are empty,
  /// no query leaves one.
  std::vector<std::int32_t> from_lattice, from_atom;
  std::array<std::vector<std::int64_t>, 3> from_cell;
  /// Those whose cells do not fit 64 bits, by row. In the columns these rows leave no obstacle.
  std::vector<std::pair<std::size_t, ObstacleId>> large_from;

  std::vector<std::string> id;  ///< as text; empty: there are no ids

  std::vector<RowFlaw> flaws;      ///< in the order of the rows; the values of these have no meaning
  std::uint64_t first = 0;         ///< the number of the first row in the file, from 0
  std::vector<std::size_t> lines;  ///< the line of each row, if the file has lines

  /// Removes all rows, but keeps allocated memory.
  void clear();
  /// Makes room for `rows` rows without limits, ids and flaws, to be set. No column becomes shorter.
  void resize(std::size_t rows, int dimension, bool with_from);
  /// The cells of `from` must fit 64 bits.
  void set(std::size_t i, const Query& query, int dimension);
  Query query(std::size_t i, int dimension) const;
};

/// Answers in columns that are as long as those of the queries. Values that an outcome does not have are 0; a
/// time that it does not have is NaN.
struct AnswerRows {
  /// Values of `stage` besides those of lorentz::Stage.
  static constexpr std::uint8_t kExactStage = 3, kNoStage = 255;

  std::size_t count = 0;
  int dimension = 0;
  std::vector<Outcome> outcome;
  std::vector<std::uint8_t> stage;
  std::unique_ptr<bool[]> time_is_rounded;
  std::vector<std::int32_t> lattice, atom;
  std::vector<std::int64_t> cells;  ///< a column per dimension, one after the other, as in Fortran
  std::vector<double> time;

  std::vector<std::pair<std::size_t, Cell>> large_cells;  ///< those that do not fit 64 bits, by row
  std::vector<RowFlaw> reasons;

  /// Makes room for `rows` rows, whose columns have no meaning yet. Removes large cells and reasons.
  void resize(std::size_t rows, int dimensions);
  /// The column of coordinate k.
  std::int64_t* cell(int k) { return cells.data() + static_cast<std::size_t>(k) * outcome.size(); }
  const std::int64_t* cell(int k) const {
    return cells.data() + static_cast<std::size_t>(k) * outcome.size();
  }
  /// Sets a row to an outcome without an obstacle or a time.
  void set_plain(std::size_t i, Outcome plain);
  void set_error(std::size_t i, std::string message, bool unsupported);
  void set(std::size_t i, const Answer& answer, std::uint8_t of_stage, bool rounded);
  /// Turns answers whose cells do not fit 64 bits into errors, for a format that has only 64 bits.
  void refuse_large_cells();
};

/// Reads queries in columns, part by part.
class ColumnReader {
 public:
  virtual ~ColumnReader() = default;

  /// Appends up to about `most` rows; false if there are no more. Throws FileError, and InputError, also
  /// after the last good row of a broken file.
  virtual bool next(QueryRows& rows, std::size_t most) = 0;

  /// Sets a function that is called when the input pauses. It can answer the rows that have been read, and
  /// clear them.
  void before_waiting(std::function<void()> callback) { before_waiting_ = std::move(callback); }

  /// The input's name in messages.
  virtual const std::string& name() const = 0;

  virtual std::uint64_t promised() const { return 0; }  ///< the number of rows, if the input begins with it
  virtual bool has_more() {
    return false;
  }  ///< if bytes follow the last row that was promised; waits for them

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

/// Called with each column that queries do not have, and with its place. If it throws, reading ends.
using OnUnknownColumn = std::function<void(const std::string& place, const std::string& column)>;

}  // namespace lorentz
