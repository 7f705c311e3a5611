// Cells of a bench: an engine over the questions of one scene, radius and difficulty.
#include <catch2/catch.hpp>

#include "cli/bench_cells.hpp"

using namespace lorentz;

TEST_CASE("Bench cells: errors in units of the condition are errors over it, not times it",
          "[cli][bench_cells]") {
  cli::ExaminationOptions options;
  options.count = 200, options.seed = 3;
  INFO("seed 3");
  const report::Cell cell = cli::measure_cells(options, {question::engine_named("published")},
                                               {.scene = "square", .radius = 0.01, .difficulty = "grazing"})
                                .cells.at(0);
  REQUIRE(cell.ulps.max > 100);  // grazing: the time is worse known by far than to an ulp
  CHECK(cell.conditions.max < cell.ulps.max / 10);
  CHECK(cell.conditions.max > 0);
}
