// Measures the cells of `lorentz bench`: all engines over the same queries.
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
  std::optional<double> radius;  ///< nothing: the scene's own sizes
  std::string difficulty;        ///< drawn, near-rational or grazing
};

struct BenchPlan {
  std::vector<EngineInfo> engines;
  std::uint64_t count = 0, seed = 0;
  Claim claim = {};               ///< all are judged by it; scenes and queries are rounded to its precision
  AnswererOptions answerer = {};  ///< for engines outside this program
};

/// Fewer queries than this say nothing.
inline constexpr std::size_t kFewestQueries = 32;

struct BenchCells {
  std::vector<report::Cell> cells;  ///< one per engine, in the engines' order
  bool failed = false;              ///< an external engine failed
};

BenchCells measure_cells(const BenchPlan& plan, const BenchGroup& group);

}  // namespace lorentz::question
