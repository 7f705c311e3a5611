// Measures the cells of `lorentz bench`: all engines over the same queries.
#pragma once

#include <vector>

#include "cli/examination_options.hpp"
#include "question/engines.hpp"
#include "report/cell.hpp"

namespace lorentz::cli {

/// Fewer queries than this say nothing.
inline constexpr std::size_t kFewestQueries = 32;

struct MeasuredCells {
  std::vector<report::Cell> cells;  ///< one per engine, in the engines' order
  bool failed = false;              ///< an external engine failed
};

/// `like`: a cell's scene, radius and difficulty. Scenes and queries are rounded to the precision of the claim, by
/// which all are judged.
MeasuredCells measure_cells(const ExaminationOptions& options,
                            const std::vector<question::EngineInfo>& engines, const report::Cell& like);

}  // namespace lorentz::cli
