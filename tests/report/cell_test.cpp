// Histograms, fits, and cells as text.
#include "report/cell_store.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include <lorentz/exchange.hpp>
#include "cases/random.hpp"
#include "report/power_fit.hpp"
#include "report/query_text.hpp"

using lorentz::InputError, lorentz::Integer, lorentz::ObstacleId, lorentz::Query;
using namespace lorentz::report;

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
  CHECK(histogram_of({}) == Histogram{});
  CHECK(histogram_of({0, 0}).counts.empty());
  CHECK_THROWS_AS(histogram_of({-1}), std::invalid_argument);
  CHECK_THROWS_AS(histogram_of({INFINITY}), std::invalid_argument);
}

TEST_CASE("Power laws are fitted in logarithms, with Student's interval", "[report][power_fit]") {
  std::vector<std::pair<double, double>> exact, rough;
  for (const double r : {1e-2, 1e-3, 1e-4, 1e-5}) exact.emplace_back(r, 7 * std::pow(r, -0.25));
  const PowerFit fit = power_fit(exact).value();
  CHECK(fit.exponent == Approx(-0.25));
  CHECK(fit.high - fit.low == Approx(0).margin(1e-6));
  CHECK((fit.from == 1e-5 && fit.to == 1e-2));
  // y = 0, 1, 1, 3 over x = 0, 1, 2, 3, as logarithms: the slope is 4.5 / 5, its standard error the root of
  // 0.7 / 2 / 5, and Student's t of two degrees of freedom 4.302653.
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 1}, {2, 1}, {3, 3}})
    rough.emplace_back(std::exp(x), std::exp(y));
  const PowerFit other = power_fit(rough).value();
  CHECK(other.exponent == Approx(0.9));
  CHECK(other.low == Approx(0.9 - 4.302652730 * 0.2645751311));
  CHECK(other.high == Approx(0.9 + 4.302652730 * 0.2645751311));
  CHECK_FALSE(power_fit({{1, 1}, {2, 2}}));
  CHECK_FALSE(power_fit({{1, 1}, {1, 2}, {1, 3}}));
  CHECK_THROWS_AS(power_fit({{1, 1}, {2, 0}, {3, 1}}), std::invalid_argument);
}

TEST_CASE("Power laws: intervals hold the exponent 95 times in 100", "[report][power_fit][coverage]") {
  constexpr int kSamples = 4000;
  for (const int points : {3, 4, 8}) {
    int inside = 0;
    for (int sample = 0; sample < kSamples; ++sample) {
      lorentz::cases::Random random(20261123, "power laws", sample);
      std::vector<std::pair<double, double>> rough;
      for (int i = 0; i < points; ++i) {
        double normal = -6;  // Irwin and Hall's
        for (int k = 0; k < 12; ++k) normal += random.uniform();
        rough.emplace_back(std::pow(10, -i), std::pow(10, 0.25 * i) * std::exp(0.1 * normal));
      }
      const PowerFit fit = power_fit(rough).value();
      inside += fit.low <= -0.25 && -0.25 <= fit.high;
    }
    INFO(points << " points: " << inside << " of " << kSamples);
    CHECK(std::abs(inside - 3800) < 4 * 13.8);
  }
}

TEST_CASE("What a store keeps of cells reads back as the same cells, or is refused", "[report][cell]") {
  Cell cell;
  cell.scene = "a \"scene\"", cell.radius = 0.1, cell.dimension = 2;
  cell.difficulty = "drawn", cell.engine = "cmd:a 'b'", cell.queries = 50;
  cell.ns = {1.5, 1, 2, 1.75};
  cell.instructions = 812.5;
  cell.mean_path = 1.0 / 3;
  cell.undecided = share_of(1, 50);
  cell.ill_posed = share_of(2, 50);
  cell.wrong = share_of(3, 50);
  cell.wrong_time = share_of(4, 50);
  cell.unsupported = 5;
  cell.error = 6;
  cell.missing = 7;
  cell.ulps = histogram_of({0, 1, 1e9});
  cell.conditions = histogram_of({0.1});
  Query query{{0.75, 0, 0}, {1, -0x1p-30, 0}, ObstacleId{0, 0, {Integer(1), Integer(-2), Integer(0)}}};
  cell.worst = Worst{"wrong", {}, hexadecimal_query(query, 2), "echo '\n"};
  CHECK(
      cell.worst->query ==
      R"({"x":["0x1.8p-1","0x0p+0"],"v":["0x1p+0","-0x1p-30"],"from":{"lattice":0,"atom":0,"cell":[1,-2]}})");
  Cell skipped;
  skipped.scene = "ellipse", skipped.dimension = 2, skipped.difficulty = "grazing", skipped.engine = "oracle";
  skipped.skipped = true;
  skipped.unsupported = 3;
  const CellStore store{{"these options", "scenes", "program"}, "{\"version\":\"1\"}", {cell, skipped}};
  const CellStore again = CellStore::of(store.text());
  CHECK(again.text() == store.text());
  CHECK(again.cells == store.cells);
  CHECK(again.run == store.run);
  CHECK_NOTHROW(store.check(again.run));
  for (const auto part : {&CellStore::Run::options, &CellStore::Run::scenes, &CellStore::Run::program}) {
    CellStore::Run other = store.run;
    other.*part = "others";
    CHECK_THROWS_AS(store.check(other), InputError);
  }
  const std::string text = store.text();
  CHECK_THROWS_WITH(CellStore::of(text.substr(0, text.size() - 30)), Catch::StartsWith("line 3 "));
  CHECK_THROWS_AS(CellStore::of(""), InputError);
  CHECK_THROWS_AS(CellStore::of("{\"bench\":2}\n"), InputError);
}
