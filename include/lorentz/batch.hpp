// Many flights in one scene at once: the reduction engine, with a query in each lane of the processor's
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

/// Queries of one scene in columns, owned by the caller: all of the same length but those that are left empty. In 2D the
/// third columns of vectors are not read.
struct QueryColumns {
  std::array<std::span<const double>, 3> x{}, v{};

  std::span<const double> max_time{};  ///< as in Reduction::fly; empty: no query has a limit

  /// The obstacle that a query leaves, which it ignores; a lattice below 0: none. All empty: no query leaves
  /// one.
  std::span<const std::int32_t> from_lattice{}, from_atom{};
  std::array<std::span<const std::int64_t>, 3> from_cell{};

  std::size_t size() const { return x[0].size(); }
  /// The query i, in so many dimensions.
  Query query(std::size_t i, int dimension) const;
  /// The queries [begin, begin + length).
  QueryColumns part(std::size_t begin, std::size_t length) const;
};

/// What they came to: the members of Flight, a column each, at least as long as those of the queries. An empty column
/// is not wanted; `outcome` is. What Flight leaves at zero (the obstacle of `never`, the time of `inside`, the third
/// cell coordinate in 2D) is zero here.
struct FlightColumns {
  std::span<Outcome> outcome{};
  std::span<Stage> stage{};
  std::span<bool> time_is_rounded{};
  std::span<std::int32_t> lattice{}, atom{};
  std::array<std::span<std::int64_t>, 3> cell{};
  std::span<double> time{};

  FlightColumns part(std::size_t begin) const;
};

/// Names the first column that is missing, or shorter than the queries are many; nothing if all of them fit a scene of
/// this dimension.
std::optional<std::string> flaw_of(const QueryColumns& queries, const FlightColumns& flights, int dimension);

/// Queries as columns of its own, filled one query at a time.
class QueryTable {
 public:
  /// Removes all queries; what is allocated stays.
  void clear();

  /// False, and nothing is added, if a cell coordinate of `from` does not fit 64 bits.
  bool push_back(const Query& query, double max_time = std::numeric_limits<double>::infinity());

  std::size_t size() const { return max_time_.size(); }
  Query operator[](std::size_t i) const;

  /// Until the next change. Without limits, and without obstacles that are left, where no query has any.
  QueryColumns columns() const;

 private:
  bool any_limit_ = false, any_from_ = false;
  std::array<std::vector<double>, 3> x_, v_;
  std::vector<double> max_time_;
  std::vector<std::int32_t> from_lattice_, from_atom_;
  std::array<std::vector<std::int64_t>, 3> from_cell_;
};

/// Flights as columns of its own.
class FlightTable {
 public:
  /// Room for so many.
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

/// First obstacles of many queries, in one scene.
///
///  1. What Reduction::fly says of each query, to the bit: outcome, stage, obstacle, time. On every
///     processor, with any number of threads.
///     held by "A batch says what one flight at a time says, to the bit, with every set of instructions",
///             "The golden sets in batches, to the bit"
///  2. A query with a flaw (flaw_of) has the outcome `error`; the others are not disturbed.
///     held by "A query with a flaw is an error of its own in a batch"
///  3. `fly` allocates nothing, beyond what starting threads takes, and throws nothing but what that throws, and
///     InputError for columns with a flaw.
///     held by "A batch allocates nothing",
///             "Columns that are missing or too short are refused"
///  4. Any number of threads may ask one batch engine.
///     held by "Threads share a batch engine"
///
/// Units, ranges and exactness: those of Reduction (reduction.hpp).
///
/// Cost: docs/speed.md. What lanes do not do, one flight at a time is asked: decisions that need the second
/// stage, sections of very many lines, starts near several obstacles that reach out of their cells. On drawn
/// queries that is less than one in some thousand.
class Batch {
 public:
  using Time = Reduction::Time;

  /// `instructions`: one of instruction_sets(), for tests and measurements; empty: the best. Throws
  /// UnsupportedError for another name, and as Reduction's constructor does.
  explicit Batch(const Scene& scene, std::string_view instructions = {});
  ~Batch();
  Batch(Batch&&) noexcept;
  Batch& operator=(Batch&&) noexcept;

  /// Answers all queries, on `jobs` threads (at least 1). Returns how many of them lanes left to single
  /// flights. Throws InputError for columns with a flaw.
  std::size_t fly(const QueryColumns& queries, const FlightColumns& flights, Time time = Time::close,
                  int jobs = 1) const;

  /// The engine of single flights that it agrees with.
  const Reduction& one_at_a_time() const;

  /// The sets of vector instructions that this processor has and the program was built for, best first
  /// ("AVX3" is AVX-512); the last is "none": one flight at a time.
  static std::vector<std::string> instruction_sets();

 private:
  struct Inside;
  Pimpl<const Inside> inside_;
};

/// The libraries that the batch engine computes with, and their versions.
std::string batch_libraries();

}  // namespace lorentz
