// Histograms, and cells as text.
#include "report/cell.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <regex>

#include <lorentz/exchange.hpp>
#include "question/cases/random.hpp"
#include "report/bench_report.hpp"
#include "report/curves.hpp"
#include "report/query_text.hpp"
#include "src/exchange/json_writer.hpp"

namespace json = lorentz::json;
using lorentz::Integer, lorentz::ObstacleId, lorentz::Query;
using namespace lorentz::report;
using lorentz::question::Count;

TEST_CASE("Histograms count errors by their binary exponent", "[report][histogram]") {
  const Histogram histogram = histogram_of({0, 0.25, 0.4999, 0.5, 0, 1, 1.99, 6});
  CHECK(histogram.exact == 2);
  CHECK(histogram.first == -2);
  CHECK(histogram.counts == std::vector<std::size_t>{2, 1, 2, 0, 1});
  CHECK(histogram.mean == Approx((0.25 + 0.4999 + 0.5 + 1 + 1.99 + 6) / 8));
  CHECK(histogram.max == 6);
  CHECK(histogram.p99 == 6);
  std::vector<double> hundred(100, 1.0);
  hundred[3] = 1e6;
  CHECK(histogram_of(hundred).p99 == 1);  // 99 of 100 do not exceed it
  hundred[5] = 1e6;
  CHECK(histogram_of(hundred).p99 == 1e6);
  CHECK((histogram_of({}).exact == 0 && histogram_of({}).counts.empty()));
  CHECK(histogram_of({0, 0}).counts.empty());
  CHECK_THROWS_AS(histogram_of({-1}), std::invalid_argument);
  CHECK_THROWS_AS(histogram_of({INFINITY}), std::invalid_argument);
}

TEST_CASE("Calls are counted by decade and verdict", "[report][calls]") {
  using lorentz::oracle::Verdict;
  Calls calls, more;
  calls.add(3e-10, Verdict::wrong);
  calls.add(-2e-10, Verdict::agree);
  calls.add(1e-3, Verdict::undecided);
  more.add(9.9e-10, Verdict::ill_posed);
  for (const auto& [radii, verdict] :
       {std::pair{std::optional<double>(), Verdict::wrong}, {0.0, Verdict::wrong}, {0.5, Verdict::error}})
    calls.add(radii, verdict);
  calls.add(more);
  REQUIRE(calls.by_decade().size() == 2);
  const Call& close = calls.by_decade().at(-10);
  CHECK((close.counts[Count::wrong] == 1 && close.counts[Count::agree] == 1 &&
         close.counts[Count::ill_posed] == 1));
  CHECK(close.counts[Count::undecided] == 0);
  CHECK(calls.by_decade().at(-3).counts[Count::undecided] == 1);
}

TEST_CASE("Cells are written with null for what was not measured", "[report][cell]") {
  Cell cell;
  cell.scene = "a \"scene\"", cell.radius = 0.1, cell.dimension = 2;
  cell.difficulty = "drawn", cell.engine = "cmd:a 'b'", cell.queries = 50;
  cell.counts[Count::wrong] = 3;
  cell.ulps = histogram_of({0, 1, 1e9});
  cell.calls.add(3e-10, lorentz::oracle::Verdict::wrong);
  Query query{{0.75, 0, 0}, {1, -0x1p-30, 0}, ObstacleId{0, 0, {Integer(1), Integer(-2), Integer(0)}}};
  cell.worst = Worst{"wrong", {}, hexadecimal_query(query, 2), "echo '\n"};
  CHECK(
      cell.worst->query ==
      R"({"x":["0x1.8p-1","0x0p+0"],"v":["0x1p+0","-0x1p-30"],"from":{"lattice":0,"atom":0,"cell":[1,-2]}})");
  const auto has = [&](const char* part) { return json::text_of(cell).find(part) != std::string::npos; };
  CHECK((has(R"("ns":null)") && has(R"("wrong":{"count":3,)")));  // of a program that broke
  cell.speed = lorentz::question::Speed{1.75, 1.5, 1, 2};
  CHECK(has(R"("ns":{"median":1.5,"q1":1,"q3":2,"mean":1.75})"));
  CHECK(has(R"("worst":{"verdict":"wrong","ulps":null,"query":{"x":)"));
  cell.skipped = lorentz::report::kTooSlow;
  CHECK((has(R"("ns":null,"mean_path":null,"ulps":null)") && has(R"("worst":null)")));
}

TEST_CASE("The table of cells has each number in its column, and the conclusion the range of medians",
          "[report][cell]") {
  Cell cell;
  cell.scene = "square", cell.radius = 0.1, cell.dimension = 2;
  cell.difficulty = "drawn", cell.engine = "mine", cell.queries = 50;
  cell.counts[Count::agree] = 50;
  cell.ulps = histogram_of({0, 1, 8});
  cell.speed = lorentz::question::Speed{17, 20, 19, 21};
  Cell slow = cell;
  slow.difficulty = "grazing", slow.skipped = lorentz::report::kTooSlow;
  const std::string text = bench_text({cell, slow}, {"mine"});
  INFO(text);
  CHECK(std::regex_search(text, std::regex("drawn +mine +50 +20 +19-21 +0 +0 +0 +0 +3 +8 +8\\n")));
  CHECK(std::regex_search(text, std::regex("grazing +mine +- +too slow")));
  CHECK(text.find("\n  20 to 20 ns; times at worst 8 ulps off") != std::string::npos);
}

TEST_CASE("A curve is written with every number under its own name", "[report][curves]") {
  FreePathCurve path{"square", "batch", 0.25, "surface", "law", {{1, 0.5, 0.75, {}}, {2, 0.125, {}, 0.0625}}};
  std::string text;
  append_json(text, path);
  CHECK(text == R"({"scene":"square","engine":"batch","radius":0.25,"from":"surface","law":"law","points":[)"
                R"({"t":1,"survival":0.5,"exact":0.75,"theory":null},)"
                R"({"t":2,"survival":0.125,"exact":null,"theory":0.0625}]})");
}
