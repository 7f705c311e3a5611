// A cell of a table of speed against error: what one engine did with the queries of one scene, at one radius,
// of one difficulty.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "report/calls.hpp"
#include "report/histogram.hpp"
#include "report/share.hpp"

namespace lorentz::report {

/// Nanoseconds a query.
struct CellTimes {
  double median = 0, q1 = 0, q3 = 0;  ///< over blocks of queries, of a block's mean
  double mean = 0;

  friend bool operator==(const CellTimes&, const CellTimes&) = default;
};

/// The input that an engine did worst with: wrong before ill-posed before the right obstacle with the largest
/// error of its time.
struct Worst {
  std::string verdict;         ///< "wrong", "ill-posed", "wrong-time" or "agree"
  std::optional<double> ulps;  ///< error of the time, where the obstacle is right
  std::string query;           ///< as JSON, its numbers hexadecimal
  std::string command;         ///< a shell line that shows it

  friend bool operator==(const Worst&, const Worst&) = default;
};

struct Cell {
  std::string scene;
  std::optional<double> radius;  ///< none: the scene's own sizes
  int dimension = 2;
  std::string difficulty, engine;
  std::size_t queries = 0;
  bool skipped = false;         ///< too slow, or all is unsupported: of what follows only that is known
  std::optional<CellTimes> ns;  ///< empty if the program broke
  std::optional<double> instructions;  ///< a query, where the processor counts them
  double mean_path = 0;                ///< mean time of the flights that hit, 0 if none does
  Share undecided, ill_posed, wrong, wrong_time;
  std::size_t unsupported = 0, error = 0, missing = 0;
  Histogram ulps;        ///< errors of the times of right hits, in ulps
  Histogram conditions;  ///< the same in units of the condition (lorentz/margin.hpp)
  Calls calls;           ///< by how many radii the line enters or misses the obstacle in question
  std::optional<Worst> worst;

  friend bool operator==(const Cell&, const Cell&) = default;
};

/// An object, its keys as the members are called; of a skipped cell null for what was not measured.
void append_json(std::string& out, const Cell& cell);

/// What append_json wrote. Throws InputError.
Cell cell_of(std::string_view json);

/// Why no engine can have come to this with up to `most` queries, or nothing: counts that do not fit
/// together, bounds that are not those of their counts, times and errors out of order.
std::string flaw_of(const Cell& cell, std::size_t most);

}  // namespace lorentz::report
