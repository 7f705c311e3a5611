// Many flights at once in one scene: the reduction engine, with one query in each lane of the processor's
// vectors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <lorentz/pimpl.hpp>
#include <lorentz/reduction.hpp>

namespace lorentz {

/// Queries of one scene as columns, owned by the caller. All columns have the same length, except those that
/// are left empty. In 2D the third columns of vectors are not read.
struct QueryColumns {
  std::array<std::span<const double>, 3> x{}, v{};

  std::span<const double> max_time{};  ///< as in Reduction::fly; if empty, no query has a limit

  /// The obstacle that a query leaves, and therefore ignores. A negative lattice means that the query leaves
  /// none. If all these columns are empty, no query leaves an obstacle.
  std::span<const std::int32_t> from_lattice{}, from_atom{};
  std::array<std::span<const std::int64_t>, 3> from_cell{};

  std::size_t size() const { return x[0].size(); }
  /// Query `i`, whose vectors have `dimension` components; those whose column is empty are zero.
  Query query(std::size_t i, int dimension) const;
  /// The queries [begin, begin + length).
  QueryColumns part(std::size_t begin, std::size_t length) const;
};

/// The results: a column for each member of Flight, at least as long as the query columns. Leave a column
/// empty if you do not need it; only `outcome` is required. Members that Flight leaves at zero (the obstacle
/// of `never`, the time of `inside`, the third cell coordinate in 2D) are zero here, too.
struct FlightColumns {
  std::span<Outcome> outcome{};
  std::span<Stage> stage{};
  std::span<bool> time_is_rounded{};
  std::span<std::int32_t> lattice{}, atom{};
  std::array<std::span<std::int64_t>, 3> cell{};
  std::span<double> time{};

  FlightColumns part(std::size_t begin) const;
  /// Writes a row, into the columns that are there.
  void set(std::size_t i, const Flight& flight) const;
};

/// Names the first column that is missing, or has another number of rows than there are queries (a column of
/// results: fewer rows). Nothing if all columns fit a scene of this dimension.
std::optional<std::string> flaw_of(const QueryColumns& queries, const FlightColumns& flights, int dimension);

/// Queries in columns that the table owns, filled one query at a time.
class QueryTable {
 public:
  /// Removes all queries but keeps allocated memory.
  void clear();

  /// Appends a query. Returns false and adds nothing if a cell coordinate of `from` does not fit into 64
  /// bits.
  bool push_back(const Query& query, double max_time = std::numeric_limits<double>::infinity());

  std::size_t size() const { return max_time_.size(); }
  Query operator[](std::size_t i) const;

  /// The columns, valid until the next change. `max_time` is empty if no query has a limit, and the columns
  /// of `from` are empty if no query leaves an obstacle.
  QueryColumns columns() const;

 private:
  bool any_limit_ = false, any_from_ = false;
  std::array<std::vector<double>, 3> x_, v_;
  std::vector<double> max_time_;
  std::vector<std::int32_t> from_lattice_, from_atom_;
  std::array<std::vector<std::int64_t>, 3> from_cell_;
};

/// Flights in columns that the table owns.
class FlightTable {
 public:
  /// Makes room for `count` flights.
  void resize(std::size_t count);
  Flight operator[](std::size_t i) const;
  FlightColumns columns();

 private:
  std::vector<Outcome> outcome_;
  std::vector<Stage> stage_;
  std::unique_ptr<bool[]> time_is_rounded_;
  std::vector<std::int32_t> lattice_, atom_;
  std::array<std::vector<std::int64_t>, 3> cell_;
  std::vector<double> time_;
};

/// First hits of many queries in one scene.
///
///  1. Each result is that of Reduction::fly, to the bit: outcome, stage, obstacle and time. This holds on
///     every processor and with any number of threads.
///  2. An invalid query (flaw_of) gets the outcome `error`; the other queries are not affected.
///  3. `fly` allocates only what starting threads needs. It throws only what starting threads throws, and
///     InputError for invalid columns (flaw_of).
///  4. Any number of threads may use one batch engine.
///
/// Units, ranges and exactness: as for Reduction (reduction.hpp).
///
/// Cost: docs/speed.md. Lanes leave rare queries to single flights: in the search in 3D, decisions that need
/// the second stage and sections of more than 12 lines; starts near several obstacles that extend beyond
/// their cells (docs/batch.md has the list). They are fewer than one in 1000 drawn queries.
class Batch {
 public:
  using Time = Reduction::Time;

  /// `instructions` is one of instruction_sets(), for tests and measurements; if empty, the best is used.
  /// Throws UnsupportedError for an unknown name, and what Reduction's constructor throws.
  explicit Batch(const Scene& scene, std::string_view instructions = {});
  ~Batch();
  Batch(Batch&&) noexcept;
  Batch& operator=(Batch&&) noexcept;

  /// Answers all queries on `jobs` threads (at least 1). Returns the number of queries that lanes left to
  /// single flights. Throws InputError for invalid columns (flaw_of).
  std::size_t fly(const QueryColumns& queries, const FlightColumns& flights, Time time = Time::close,
                  int jobs = 1) const;

  /// The engine for single flights with which the batch agrees.
  const Reduction& one_at_a_time() const;

  /// The sets of vector instructions that this processor has and the program was built for, best first
  /// ("AVX3" is AVX-512). The last is "none": one flight at a time.
  static std::vector<std::string> instruction_sets();

 private:
  struct Inside;
  Pimpl<const Inside> inside_;
};

/// Names and versions of the libraries that the batch engine uses.
std::string batch_libraries();

}  // namespace lorentz
