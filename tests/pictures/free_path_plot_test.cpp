// Pictures of free paths: what is shown, and where.
#include "pictures/free_path_plot.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <stdexcept>

#include "tests/support/svg_reader.hpp"

using namespace lorentz::pictures;
using namespace lorentz::test;

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

// At every corner to the same side.
bool is_convex(const std::string& corners) {
  static const std::regex kCorner(R"(([0-9.]+),([0-9.]+))");
  std::vector<Point> p;
  for (std::sregex_iterator it(corners.begin(), corners.end(), kCorner), end; it != end; ++it)
    p.push_back({std::stod((*it)[1]), std::stod((*it)[2])});
  int left = 0, right = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point &a = p[i], &b = p[(i + 1) % p.size()], &c = p[(i + 2) % p.size()];
    const double turn = (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
    left += turn > 0.1;
    right += turn < -0.1;
  }
  return left + right == static_cast<int>(p.size()) && (left == 0 || right == 0);
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
  plot.axes = AxisScale::linear;
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
    CHECK(is_convex(corners));
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

namespace {

// An axis read off its numbers: where they stand on the paper, and what they say.
struct Scale {
  std::vector<std::pair<double, double>> ticks;  // (paper, number)
  bool logarithmic;

  double operator()(double paper) const {
    const auto [p0, x0] = ticks.front();
    const auto [p1, x1] = ticks.back();
    const double share = (paper - p0) / (p1 - p0);
    return logarithmic ? x0 * std::pow(x1 / x0, share) : x0 + share * (x1 - x0);
  }
};

// "10⁻³", "0.2"
double number_in(const std::string& label) {
  static const std::string kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string plain = label;
  for (int digit = 0; digit < 10; ++digit)
    for (std::size_t at; (at = plain.find(kDigits[digit])) != std::string::npos;)
      plain.replace(at, kDigits[digit].size(), std::to_string(digit));
  const auto minus = plain.find("⁻");
  if (plain == label || plain.substr(0, 2) != "10") return std::stod(label);
  return minus == std::string::npos ? std::pow(10, std::stod(plain.substr(2)))
                                    : std::pow(10, -std::stod(plain.substr(2 + std::string("⁻").size())));
}

// A plot as one reads it: by the numbers at its axes.
struct Reading {
  SvgPicture picture;
  Rectangle frame;
  Scale t, value;

  Reading(const std::string& svg, bool logarithmic)
      : picture(svg), t{{}, logarithmic}, value{{}, logarithmic} {
    CHECK(picture.beyond_page() == "");
    const Ink box = picture.all("polygon", "stroke", "#222222").at(0);
    frame = {box.points[0], box.points[2]};
    for (const Ink& text : picture.all("text")) {
      if (text.words.find_first_not_of("0123456789.e+-⁰¹²³⁴⁵⁶⁷⁸⁹⁻") != std::string::npos) continue;
      const bool along_t = text.is("text-anchor", "middle");
      // Beside it on the frame: a tick's mark, and a line of the grid across.
      const Spot foot = along_t ? Spot{text.centre.x, frame.high.y} : Spot{frame.low.x, text.centre.y - 7};
      const Spot far = along_t ? Spot{foot.x, frame.low.y} : Spot{frame.high.x, foot.y};
      int marks = 0, across = 0;
      for (const Ink& line : picture.all("line")) {
        if (distance(line.points[0], foot) > 0.02) continue;
        const Spot way = line.points[1] - foot;
        marks += line.is("stroke", "#222222") &&
                 (along_t ? way.y < -3 && std::fabs(way.x) < 0.02 : way.x > 3 && std::fabs(way.y) < 0.02);
        across += distance(line.points[1], far) < 0.02;
      }
      INFO(text.words << " at " << foot.x << ", " << foot.y);
      CHECK(marks == 1);
      CHECK((logarithmic ? across <= 1 : across == 1));
      CHECK(std::fabs(along_t ? text.centre.y - frame.high.y - 26 : text.centre.x - frame.low.x + 9) < 0.02);
      (along_t ? t : value).ticks.push_back({along_t ? foot.x : foot.y, number_in(text.words)});
    }
    for (Scale* scale : {&t, &value}) {
      REQUIRE(scale->ticks.size() > 1);
      std::sort(scale->ticks.begin(), scale->ticks.end(), [](auto a, auto b) { return a.second < b.second; });
      for (const auto& [paper, number] : scale->ticks)
        CHECK((*scale)(paper) == Approx(number).epsilon(1e-3).margin(1e-9));
    }
    CHECK(t.ticks.front().first < t.ticks.back().first);          // to the right
    CHECK(value.ticks.front().first > value.ticks.back().first);  // upwards
  }

  Spot at(Spot paper) const { return {t(paper.x), value(paper.y)}; }

  // To about the hundredth of a pixel.
  bool shows(Spot paper, double x, double y) const {
    const Spot right = at({paper.x + 0.03, paper.y + 0.03}), left = at({paper.x - 0.03, paper.y - 0.03});
    return left.x <= x && x <= right.x && right.y <= y && y <= left.y;
  }
};

// The middle of a marker's square.
Spot middle(const Ink& marker) {
  if (marker.kind == "ellipse") return marker.centre;
  Spot low{1e9, 1e9}, high{-1e9, -1e9};
  for (const Spot p : marker.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {(low.x + high.x) / 2, (low.y + high.y) / 2};
}

// Three series and three curves, of all sorts.
FreePathPlot several(AxisScale axes) {
  FreePathPlot plot;
  plot.axes = axes;
  plot.title = "Free paths";
  plot.note = "what is written below";
  plot.t_label = "t in cells";
  plot.value_label = "share";
  for (int s = 0; s < 3; ++s) {
    PlotSeries series{"series " + std::string(1, static_cast<char>('A' + s)), {}};
    for (int i = 0; i < 6; ++i) {
      const double t = 0.3 * (i + 1) * (1 + 0.2 * s), value = 0.9 / (s + 1) / (1 + t * t);
      series.points.push_back({t, value, value / (4 + 3 * s)});
    }
    plot.series.push_back(series);
  }
  for (const int series : {1, -1, 0}) {
    PlotCurve curve{series < 0 ? "theory" : "law " + std::to_string(series), {}, series, series == 0};
    for (int i = 0; i < 20; ++i) curve.points.push_back({0.3 + 0.1 * i, 0.7 / (series + 2) / (1 + 0.1 * i)});
    plot.curves.push_back(curve);
  }
  plot.curves.push_back({"", {{0.5, 0.5}, {1, 0.3}}, 2, false});
  return plot;
}

}  // namespace

TEST_CASE("Free paths: points, error bars and curves are at the data's values, by the axes' numbers",
          "[pictures][free_path_plot]") {
  const AxisScale axes = GENERATE(AxisScale::logarithmic, AxisScale::linear);
  const FreePathPlot plot = several(axes);
  const Reading read(draw_free_paths(plot), axes == AxisScale::logarithmic);
  const SvgPicture& picture = read.picture;
  std::set<std::string> colours;
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    INFO(plot.series[s].name);
    const Ink entry = picture.mark_of(plot.series[s].name);
    colours.insert(entry["stroke"]);
    CHECK(entry.centre.y + middle(entry).y > 0);
    CHECK(std::fabs(middle(entry).y - picture.text(plot.series[s].name).centre.y + 7) < 1.2);
    // Its marker, as often as it has points, and once in the legend.
    const Inks markers = picture.all(entry.kind, [&](const Ink& ink) {
      return ink.is("stroke", entry["stroke"]) && ink.is("fill-opacity", "0.35") &&
             ink.points.size() == entry.points.size();
    });
    REQUIRE(markers.size() == 7);
    const Inks bars = picture.all("line", [&](const Ink& ink) {
      return ink.is("stroke", entry["stroke"]) && ink.is("stroke-width", "1.6");
    });
    std::size_t bar = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      const auto& [t, value, error] = plot.series[s].points[i];
      // A triangle's middle is not its square's; the middle of any is on its bar.
      const Spot place = middle(markers[i]), shift = s == 2 ? Spot{0, 5.5 * 0.2} : Spot{};
      CHECK(read.shows({place.x + shift.x, place.y + shift.y}, t, value));
      const double low = std::max(value - error, read.at({0, read.frame.high.y}).y);
      if (std::fabs(read.value.ticks[0].first) > 0 && bar + 3 > bars.size()) continue;
      if (!read.shows(bars[bar].points[0], t, value + error)) continue;  // too short to be drawn
      CHECK(read.shows(bars[bar].points[1], t, low));
      for (int end = 0; end < 2; ++end) {
        const Inks caps{bars[bar + 1 + end]};
        const Spot there = bars[bar].points[end];
        CHECK(distance(caps[0].points[0], {there.x - 4, there.y}) < 0.02);
        CHECK(distance(caps[0].points[1], {there.x + 4, there.y}) < 0.02);
      }
      bar += 3;
    }
    CHECK(bar == bars.size());
    CHECK(bar >= 9);
  }
  CHECK(colours.size() == 3);
  const Inks curves = picture.all("line", [](const Ink& ink) { return ink.clip.has_value(); });
  REQUIRE(curves.size() == 4);
  for (std::size_t c = 0; c < 4; ++c) {
    INFO("curve " << c);
    const PlotCurve& curve = plot.curves[c];
    REQUIRE(curves[c].points.size() == curve.points.size());
    for (std::size_t i = 0; i < curve.points.size(); ++i)
      CHECK(read.shows(curves[c].points[i], curve.points[i].x, curve.points[i].y));
    CHECK(distance(curves[c].clip->low, read.frame.low) + distance(curves[c].clip->high, read.frame.high) <
          0.02);
    CHECK(curves[c]["stroke-dasharray"].empty() == !curve.dashed);
    if (curve.series >= 0)
      CHECK(curves[c]["stroke"] == picture.mark_of(plot.series[curve.series].name)["stroke"]);
    else
      CHECK(colours.count(curves[c]["stroke"]) == 0);
    if (curve.name.empty()) continue;
    const Ink entry = picture.mark_of(curve.name);
    CHECK(entry["stroke"] == curves[c]["stroke"]);
    CHECK(entry["stroke-dasharray"] == curves[c]["stroke-dasharray"]);
    CHECK(std::fabs(entry.points[0].y - picture.text(curve.name).centre.y + 7) < 0.02);
  }
  // What is written: above, below, beneath the axis and along the other.
  const Ink below = picture.text("t in cells"), beside = picture.text("share");
  CHECK(below.centre.x == Approx((read.frame.low.x + read.frame.high.x) / 2));
  CHECK(below.centre.y > read.frame.high.y + 26);
  CHECK(below["text-anchor"] == "middle");
  CHECK(beside.centre.y == Approx((read.frame.low.y + read.frame.high.y) / 2).margin(1));
  CHECK(beside.direction.x == Approx(0).margin(1e-9));
  CHECK(beside.direction.y == Approx(-1));  // it is read upwards
  CHECK(beside.centre.x < read.frame.low.x - 40);
  CHECK(picture.text("Free paths").centre.y < read.frame.low.y);
  CHECK(picture.text("what is written below").centre.y > below.centre.y);
  // The frame holds all points, their bars as far as a third of the value, and no more than it has to.
  double most_t = 0, most = 0;
  for (const PlotSeries& series : plot.series)
    for (const MeasuredPoint& point : series.points) {
      most_t = std::max(most_t, point.t);
      most = std::max(most, point.value + point.error);
    }
  const Spot end = read.at({read.frame.high.x, read.frame.low.y});
  CHECK(end.x > most_t);
  CHECK(end.y > most);
  CHECK(end.x < 2.1 * most_t);
  CHECK(end.y < 2.1 * most);
  const double least = read.at({read.frame.low.x, read.frame.high.y}).y;
  for (const PlotSeries& series : plot.series)
    for (const MeasuredPoint& point : series.points) CHECK(least < point.value - point.error);
}

TEST_CASE("Free paths: the legend stands where it hides the fewest points, and holds its entries",
          "[pictures][free_path_plot]") {
  const bool rising = GENERATE(false, true);
  FreePathPlot plot;
  plot.axes = AxisScale::linear;
  plot.series = {{"a series", {}}, {"another one with a longer name", {}}};
  for (int i = 1; i <= 24; ++i) {
    plot.series[0].points.push_back({1.0 * i, rising ? 1.0 * i : 25.0 - i, 0});
    plot.series[1].points.push_back({1.0 * i, rising ? 0.97 * i : 24.4 - i, 0});
  }
  plot.curves = {{"curve", {{1, 1}, {2, 2}}, -1, false}};
  const Reading read(draw_free_paths(plot), false);
  const Inks boxes = read.picture.all("polygon", "fill-opacity", "0.85");
  REQUIRE(boxes.size() == 1);
  const Rectangle box{boxes[0].points[0], boxes[0].points[2]};
  CHECK(box.holds(read.picture.text("curve").centre));
  CHECK(Rectangle{read.frame}.holds(box.low));
  CHECK(Rectangle{read.frame}.holds(box.high));
  // A rising line leaves free the upper left, a falling one the lower left: the first of the free ones.
  CHECK(box.low.x - read.frame.low.x == Approx(16));
  CHECK((rising ? box.low.y - read.frame.low.y : read.frame.high.y - box.high.y) == Approx(16));
  for (const PlotSeries& series : plot.series) {
    const Ink words = read.picture.text(series.name);
    CHECK(box.holds(words.centre));
    CHECK(box.holds({words.centre.x + 20 * 0.56 * static_cast<double>(series.name.size()), words.centre.y},
                    0.02));
    const Spot mark = middle(read.picture.mark_of(series.name));
    CHECK(mark.x - box.low.x == Approx(28).margin(0.02));
    CHECK(words.centre.x - mark.x == Approx(28).margin(0.02));
    CHECK(words.centre.y - mark.y == Approx(7).margin(0.02));
  }
}

TEST_CASE("Free paths: long lines are written smaller, so that they fit", "[pictures][free_path_plot]") {
  FreePathPlot plot = hyperbola();
  plot.title = std::string(100, 'm');
  plot.note = "é" + std::string(120, 'n');
  const Reading read(draw_free_paths(plot), true);
  const Ink title = read.picture.text(plot.title), note = read.picture.text(plot.note);
  CHECK(title.number("font-size") == Approx(read.frame.width() / (0.56 * 100)).margin(0.06));
  CHECK(note.number("font-size") == Approx((800 - 28) / (0.56 * 121)).margin(0.06));
  CHECK(title.centre.x == Approx(read.frame.low.x));
  plot.title = "short";
  CHECK(SvgPicture(draw_free_paths(plot)).text("short").number("font-size") == 22);
}

TEST_CASE("Free paths: within a decade there are eight more marks, if there is room for them",
          "[pictures][free_path_plot]") {
  // As many decades as these along t; the marks at its foot.
  const auto marks_over = [](int decades) {
    FreePathPlot plot;
    plot.series = {{"one", {{1, 0.1, 0}, {std::pow(10, decades), 1, 0}}}};
    const Reading read(draw_free_paths(plot), true);
    std::set<long> feet;
    const double low = read.t.ticks.front().first;
    for (const Ink& line : read.picture.all("line"))
      if (line.is("stroke", "#222222") && std::fabs(line.points[0].y - read.frame.high.y) < 0.02 &&
          line.points[1].y < line.points[0].y - 2 && std::fabs(line.points[0].x - line.points[1].x) < 0.02)
        feet.insert(std::lround(100 * (line.points[0].x - low)));
    return std::pair(feet, read);
  };
  const auto [few, read] = marks_over(3);
  const double decade = (read.t.ticks.back().first - read.t.ticks.front().first) /
                        std::log10(read.t.ticks.back().second / read.t.ticks.front().second);
  for (int exponent = 0; exponent < 3; ++exponent)
    for (int digit = 1; digit < 10; ++digit) {
      const double at = 100 * decade * (std::log10(digit) + exponent);
      INFO(digit << " times 10^" << exponent);
      CHECK(std::any_of(few.begin(), few.end(), [&](long foot) { return std::fabs(foot - at) < 4; }));
    }
  CHECK(marks_over(30).first.size() <= 33);
}
