// The cells of `lorentz bench`, measured: all engines over the same queries.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/claim.hpp>
#include "question/engines.hpp"
#include "report/cell.hpp"

namespace lorentz::question {

/// The cells that are measured together: those of all engines over the same queries.
struct BenchGroup {
  std::string scene;             ///< a name of the catalogue or a file
  std::optional<double> radius;  ///< none: the scene's own sizes
  std::string difficulty;        ///< drawn, near-rational or grazing
};

struct BenchPlan {
  std::vector<EngineInfo> engines;
  std::uint64_t count = 0, seed = 0;
  double timeout = 0;  ///< of other programs
  Claim claim = {};    ///< by which all are judged; scenes and queries are rounded to its precision
  Listener listener = {};
};

/// A number as reports have it.
std::string text_of(double number);

/// Fewer queries than that say nothing.
inline constexpr std::size_t kFewestQueries = 32;

struct BenchCells {
  std::vector<report::Cell> cells;  ///< one an engine, in their order
  bool failed = false;              ///< another program broke
};

BenchCells measure_cells(const BenchPlan& plan, const BenchGroup& group);

}  // namespace lorentz::question
