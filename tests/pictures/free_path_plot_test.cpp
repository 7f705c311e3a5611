// Pictures of free paths: what is shown, and where.
#include "pictures/free_path_plot.hpp"

#include <catch2/catch.hpp>

#include <regex>
#include <set>
#include <stdexcept>

using namespace lorentz::pictures;

namespace {

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// 1/t at 1, 10, .. 10^4, the errors a tenth, and the exact curve in the series' colour.
FreePathPlot hyperbola() {
  FreePathPlot plot;
  plot.title = "Free & <long>";
  PlotSeries series{"measured", {}};
  PlotCurve curve{"theory", {}, 0, false};
  for (double t = 1; t < 2e4; t *= 10) {
    series.points.push_back({t, 1 / t, 0.1 / t});
    curve.points.push_back({t, 1 / t});
  }
  plot.series = {series};
  plot.curves = {curve};
  return plot;
}

std::vector<Point> circles(const std::string& svg) {
  static const std::regex kCircle(R"re(<circle cx="([0-9.]+)" cy="([0-9.]+)")re");
  std::vector<Point> found;
  for (std::sregex_iterator it(svg.begin(), svg.end(), kCircle), end; it != end; ++it)
    found.push_back({std::stod((*it)[1]), std::stod((*it)[2])});
  return found;
}

}  // namespace

TEST_CASE("Free paths: both axes are logarithmic", "[pictures][free_path_plot]") {
  const std::string svg = draw_free_paths(hyperbola());
  const auto points = circles(svg);
  REQUIRE(points.size() == 6);  // and one in the legend
  for (std::size_t i = 1; i < 5; ++i) {
    CHECK(points[i].x - points[i - 1].x == Approx(points[1].x - points[0].x).margin(0.03));
    CHECK(points[i].y - points[i - 1].y == Approx(points[1].y - points[0].y).margin(0.03));
    CHECK(points[i].y > points[i - 1].y);  // downwards
  }
  // The curve goes through the points.
  for (std::size_t i = 0; i < 5; ++i)
    CHECK(svg.find(fmt::format("{:.2f},{:.2f}", points[i].x, points[i].y)) != std::string::npos);
  CHECK(svg.find(">10³</text>") != std::string::npos);
  CHECK(svg.find(">10⁻³</text>") != std::string::npos);
  CHECK(svg.find("Free &amp; &lt;long&gt;") != std::string::npos);
  CHECK(svg.find("font-size=\"20\"") != std::string::npos);
}

TEST_CASE("Free paths: linear axes begin at 0", "[pictures][free_path_plot]") {
  FreePathPlot plot;
  plot.axes = Axes::linear;
  PlotSeries series{"measured", {}};
  PlotCurve curve{"theory", {}, 0, false};
  for (int i = 1; i <= 5; ++i) {
    series.points.push_back({0.5 * i, 0.2 * (6 - i), 0.01});
    curve.points.push_back({0.5 * i, 0.2 * (6 - i)});
  }
  series.points.push_back({-1, 0.5, 0});  // not shown
  plot.series = {series};
  plot.curves = {curve};
  const std::string svg = draw_free_paths(plot);
  const auto points = circles(svg);
  REQUIRE(points.size() == 6);  // and one in the legend
  for (std::size_t i = 1; i < 5; ++i) {
    CHECK(points[i].x - points[i - 1].x == Approx(points[1].x - points[0].x).margin(0.03));
    CHECK(points[i].y - points[i - 1].y == Approx(points[1].y - points[0].y).margin(0.03));
    CHECK(svg.find(fmt::format("{:.2f},{:.2f}", points[i].x, points[i].y)) != std::string::npos);
  }
  // One step before the first is 0, at the left edge.
  CHECK(svg.find(fmt::format("<rect x=\"{:.2f}\"", 2 * points[0].x - points[1].x)) != std::string::npos);
  CHECK(svg.find("text-anchor=\"end\">0</text>") != std::string::npos);
  for (const char* number : {">0.2</text>", ">0.5</text>", ">2</text>"})
    CHECK(svg.find(number) != std::string::npos);
  plot.series[0].points = {{1, 0, 0}};
  plot.curves.clear();
  CHECK_THROWS_AS(draw_free_paths(plot), std::invalid_argument);
}

TEST_CASE("Free paths: error bars, also such as reach down to 0", "[pictures][free_path_plot]") {
  FreePathPlot plot = hyperbola();
  plot.curves.clear();
  const auto bars = [](const std::string& svg) { return times(svg, "stroke-width=\"1.6\""); };
  CHECK(bars(draw_free_paths(plot)) == 15);  // a line and two ends each
  plot.series[0].points[2].error = 0;
  CHECK(bars(draw_free_paths(plot)) == 12);
  plot.series[0].points[4].error = 2e-4;  // 1e-4 -+ 2e-4
  const std::string svg = draw_free_paths(plot);
  CHECK(bars(svg) == 12);
  for (const char* bad : {"nan", "inf"}) CHECK(svg.find(bad) == std::string::npos);
  plot.series[0].points.push_back({5, 0, 0});  // nothing counted
  plot.series[0].points.push_back({0, 1, 0});
  CHECK(circles(draw_free_paths(plot)).size() == 6);
}

TEST_CASE("Free paths: series differ in shape, not in colour alone", "[pictures][free_path_plot]") {
  FreePathPlot plot = hyperbola();
  while (plot.series.size() < 6) plot.series.push_back(plot.series[0]);
  const std::string svg = draw_free_paths(plot);
  // Outlines of markers, about their first corner.
  static const std::regex kMarker(R"re(<polygon points="([^"]+)" fill="(#[0-9a-f]+)" fill-opacity="0.35")re");
  std::set<std::string> shapes, colours;
  for (std::sregex_iterator it(svg.begin(), svg.end(), kMarker), end; it != end; ++it) {
    const std::string corners = (*it)[1];
    double x0 = 0, y0 = 0;
    std::string shape;
    static const std::regex kCorner(R"(([0-9.]+),([0-9.]+))");
    for (std::sregex_iterator corner(corners.begin(), corners.end(), kCorner); corner != end; ++corner) {
      const double x = std::stod((*corner)[1]), y = std::stod((*corner)[2]);
      if (shape.empty()) x0 = x, y0 = y;
      shape += fmt::format("{:.0f} {:.0f},", x - x0, y - y0);
    }
    shapes.insert(shape);
    colours.insert((*it)[2]);
  }
  CHECK(colours.size() == 5);
  CHECK(shapes.size() >= 5);
  CHECK(circles(svg).size() == 6);
}

TEST_CASE("Free paths: nothing to show is refused", "[pictures][free_path_plot]") {
  FreePathPlot plot;
  CHECK_THROWS_AS(draw_free_paths(plot), std::invalid_argument);
  plot.series = {{"none", {{1, 0, 0}, {-1, 1, 0}}}};
  CHECK_THROWS_AS(draw_free_paths(plot), std::invalid_argument);
  plot.curves = {{"one", {{1, 1}, {2, 0.5}}, -1, true}};
  CHECK(draw_free_paths(plot).find("stroke-dasharray") != std::string::npos);
  plot.curves.clear();
  plot.series = {{"one point", {{3, 0.2, 0.01}}}};
  CHECK(circles(draw_free_paths(plot)).size() == 2);
}
