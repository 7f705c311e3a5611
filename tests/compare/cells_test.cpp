// Cells of a bench: an engine over the questions of one scene, radius and difficulty.
#include <catch2/catch.hpp>

#include "question/cells/cells.hpp"

using namespace lorentz;

TEST_CASE("Bench cells: errors in units of the condition are errors over it, not times it",
          "[compare][cells]") {
  question::BenchPlan plan;
  plan.engines = {question::engine_named("published")};
  plan.count = 200, plan.seed = 3;
  INFO("seed 3");
  const report::Cell cell = question::measure_cells(plan, {"square", 0.01, "grazing"}).cells.at(0);
  REQUIRE(cell.ulps.max > 100);  // grazing: the time is worse known by far than to an ulp
  CHECK(cell.conditions.max < cell.ulps.max / 10);
  CHECK(cell.conditions.max > 0);
}
