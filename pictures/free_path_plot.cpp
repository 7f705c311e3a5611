#include "pictures/free_path_plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace lorentz::pictures {
namespace {

// Colours that colour-blind people can tell apart (after Okabe & Ito), and dark enough for thin lines.
constexpr const char* kSeriesColours[] = {"#0072b2", "#d55e00", "#009e73", "#aa4499", "#7a5c00", "#444444"};
constexpr const char* kGrey = "#777777";
constexpr double kLetterSize = 20;  // font size, so that it is 10 at half the width
constexpr double kAdvance = 0.56;   // approximate width of a letter, in font sizes

// In UTF-8 each letter has one byte that is not a continuation byte.
std::size_t letters_in(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

const char* colour_of(int series) {
  return series < 0 ? kGrey : kSeriesColours[static_cast<std::size_t>(series) % std::size(kSeriesColours)];
}

// The smallest of 1, 2, 5, 10, 20, .. that is `least` or more.
double round_step(double least) {
  const double decade = std::pow(10, std::floor(std::log10(least)));
  for (const double digit : {1, 2, 5})
    if (digit * decade >= least * (1 - 1e-9)) return digit * decade;
  return 10 * decade;
}

// The range of one axis: powers of ten, or for a linear axis from 0 on.
struct AxisRange {
  AxisScale axes = AxisScale::logarithmic;
  double low = std::numeric_limits<double>::infinity(), high = 0;

  bool can_show(double x) const { return std::isfinite(x) && (axes == AxisScale::linear ? x >= 0 : x > 0); }
  bool empty() const { return high == 0; }
  void include(double x) {
    if (!can_show(x)) return;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  double decades() const { return std::log10(high / low); }
  bool holds(double x) const { return x >= low * (1 - 1e-12) && x <= high * (1 + 1e-12); }
  /// Its place on the axis, from 0 to 1.
  double place(double x) const {
    return axes == AxisScale::linear ? (x - low) / (high - low) : std::log10(x / low) / decades();
  }

  // Lets the range end at a digit times a power of ten, with no point on the frame.
  void round() {
    if (axes == AxisScale::linear) {
      const double step = round_step(1.02 * high / 10);
      low = 0;
      high = step * std::ceil(1.02 * high / step);
      return;
    }
    low = rounded(low / 1.02, [](double digits) { return std::floor(digits); });
    high = rounded(high * 1.02, [](double digits) { return std::ceil(digits); });
  }

 private:
  static double rounded(double x, double (*whole)(double)) {
    const double decade = std::pow(10, std::floor(std::log10(x)));
    return decade * whole(x / decade);
  }
};

struct Frame {
  AxisRange t, value;
  double left, right, top, bottom;  // in pixels

  Point operator()(double x, double y) const {
    return {left + (right - left) * t.place(x), bottom - (bottom - top) * value.place(y)};
  }
  bool can_show(const MeasuredPoint& point) const {
    return t.can_show(point.t) && value.can_show(point.value) && std::isfinite(point.error);
  }
  bool can_show(const Point& point) const { return t.can_show(point.x) && value.can_show(point.y); }
};

// Measured points must be visible; curves only where there are points, and somewhat beyond.
void set_ranges(const FreePathPlot& plot, Frame& frame) {
  for (const PlotSeries& series : plot.series)
    for (const MeasuredPoint& point : series.points)
      if (frame.can_show(point)) {
        frame.t.include(point.t);
        frame.value.include(point.value);
        frame.value.include(std::max(point.value - point.error, point.value / 3));
        frame.value.include(point.value + point.error);
      }
  if (frame.t.empty())
    for (const PlotCurve& curve : plot.curves)
      for (const Point& point : curve.points)
        if (frame.can_show(point)) {
          frame.t.include(point.x);
          frame.value.include(point.y);
        }
  if (frame.t.empty() || frame.value.empty()) throw std::invalid_argument("nothing above 0 to be drawn");
  frame.t.round();
  frame.value.round();
}

std::string power_of_ten(int exponent) {
  static const char* const kSuperscripts[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  if (exponent == 0) return "1";
  if (exponent == 1) return "10";
  if (exponent == -1) return "0.1";
  std::string out = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) out += kSuperscripts[digit - '0'];
  return out;
}

std::string stroke(const char* colour, double width, const char* more = "") {
  return fmt::format("stroke=\"{}\" stroke-width=\"{}\" {}", colour, width, more);
}

// A tick on one axis at x, its number if it has one, and a grid line if its colour is given.
struct Tick {
  double x, length;
  const char* grid = nullptr;
  std::string label = {};
};

void add_tick(Svg& svg, const Frame& frame, bool along_t, const Tick& tick) {
  const Point at = along_t ? frame(tick.x, frame.value.low) : frame(frame.t.low, tick.x),
              far = along_t ? Point{at.x, frame.top} : Point{frame.right, at.y};
  if (tick.grid) svg.polyline({at, far}, stroke(tick.grid, 1));
  if (tick.length > 0)
    svg.polyline({at, along_t ? Point{at.x, at.y - tick.length} : Point{at.x + tick.length, at.y}},
                 stroke("#222222", 1.4));
  if (tick.label.empty()) return;
  svg.text(along_t ? Point{at.x, at.y + 26} : Point{at.x - 9, at.y + 7}, tick.label,
           fmt::format("text-anchor=\"{}\"", along_t ? "middle" : "end"));
}

constexpr const char *kGrid = "#d4d4d4", *kLightGrid = "#ebebeb";

// The smallest distance between numbers along an axis, in pixels.
double apart(bool along_t) {
  return along_t ? 62 : 34;
}

// Adds decades, and within them 2 and 5 if there is room.
void add_decades(Svg& svg, const Frame& frame, bool along_t, double pixels) {
  const AxisRange& range = along_t ? frame.t : frame.value;
  const double decade = pixels / range.decades();
  const int every = static_cast<int>(std::ceil(apart(along_t) / decade));
  const auto first = static_cast<int>(std::floor(std::log10(range.low))),
             last = static_cast<int>(std::ceil(std::log10(range.high)));
  for (int exponent = first; exponent <= last; ++exponent)
    for (int digit = 1; digit < 10; ++digit) {
      const double x = digit * std::pow(10, exponent);
      if (!range.holds(x)) continue;
      const bool major = digit == 1 && exponent % every == 0;
      Tick tick{x, major ? 9.0 : digit == 1 ? 6.0 : 4.0};
      if (digit == 1) tick.grid = major ? kGrid : kLightGrid;
      if (digit != 1 && decade <= 45) tick.length = 0;
      const bool between = range.decades() < 1.7 && (digit == 2 || digit == 5);
      if (major || between) tick.label = digit == 1 ? power_of_ten(exponent) : fmt::format("{:.4g}", x);
      add_tick(svg, frame, along_t, tick);
    }
}

// Adds round numbers at equal distances.
void add_steps(Svg& svg, const Frame& frame, bool along_t, double pixels) {
  const AxisRange& range = along_t ? frame.t : frame.value;
  const double step = round_step(range.high * apart(along_t) / pixels);
  for (int i = 0; i * step <= range.high * (1 + 1e-9); ++i)
    add_tick(svg, frame, along_t, {i * step, 9, kGrid, fmt::format("{:.4g}", i * step)});
}

// Adds grid, ticks and their numbers.
void add_axis(Svg& svg, const Frame& frame, bool along_t) {
  const double pixels = along_t ? frame.right - frame.left : frame.bottom - frame.top;
  if (frame.t.axes == AxisScale::linear)
    add_steps(svg, frame, along_t, pixels);
  else
    add_decades(svg, frame, along_t, pixels);
}

void add_axes(Svg& svg, const Frame& frame, const FreePathPlot& plot) {
  add_axis(svg, frame, true);
  add_axis(svg, frame, false);
  svg.rectangle({frame.left, frame.top}, {frame.right, frame.bottom},
                "fill=\"none\" " + stroke("#222222", 1.4));
  svg.text({(frame.left + frame.right) / 2, frame.bottom + 56}, plot.t_label, "text-anchor=\"middle\"");
  svg.text({0, 0}, plot.value_label,
           fmt::format("text-anchor=\"middle\" transform=\"translate({:.0f} {:.0f}) rotate(-90)\"",
                       kLetterSize + 4, (frame.top + frame.bottom) / 2));
}

void add_marker(Svg& svg, Point at, std::size_t series) {
  const std::string style =
      fmt::format("fill=\"{0}\" fill-opacity=\"0.35\" stroke=\"{0}\" stroke-width=\"1.8\"",
                  colour_of(static_cast<int>(series)));
  static const std::vector<Point> kCorners[] = {
      {},  // a circle
      {{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}},
      {{0, -1.25}, {1.15, 0.85}, {-1.15, 0.85}},
      {{0, -1.35}, {1.2, 0}, {0, 1.35}, {-1.2, 0}},
      {{0, 1.25}, {1.15, -0.85}, {-1.15, -0.85}},
      {{-1.2, -0.5}, {0, -1.2}, {1.2, -0.5}, {1.2, 0.5}, {0, 1.2}, {-1.2, 0.5}}};
  constexpr double r = 5.5;
  std::vector<Point> corners = kCorners[series % std::size(kCorners)];
  if (corners.empty()) return svg.ellipse(at, {r, r, 0}, style);
  for (Point& corner : corners) corner = {at.x + r * corner.x, at.y + r * corner.y};
  svg.polygon(corners, style);
}

// Adds a series' points and their error bars, in front of everything else.
void add_series(Svg& svg, const Frame& frame, const PlotSeries& series, std::size_t number) {
  const std::string bar = stroke(colour_of(static_cast<int>(number)), 1.6);
  for (const MeasuredPoint& point : series.points) {
    if (!frame.can_show(point)) continue;
    const Point at = frame(point.t, point.value);
    const double low = std::max(point.value - point.error, frame.value.low);
    const Point top = frame(point.t, point.value + point.error), bottom = frame(point.t, low);
    if (bottom.y - top.y > 4) {
      svg.polyline({top, bottom}, bar);
      for (const Point& end : {top, bottom}) svg.polyline({{end.x - 4, end.y}, {end.x + 4, end.y}}, bar);
    }
    add_marker(svg, at, number);
  }
}

std::string style_of(const PlotCurve& curve) {
  return stroke(colour_of(curve.series), 2.2, curve.dashed ? "stroke-dasharray=\"9 6\"" : "");
}

// The frame cuts off the parts outside.
void add_curve(Svg& svg, const Frame& frame, const PlotCurve& curve) {
  std::vector<Point> line;
  for (const Point& point : curve.points)
    if (frame.can_show(point)) line.push_back(frame(point.x, point.y));
  svg.polyline(line, style_of(curve) + " clip-path=\"url(#frame)\"");
}

constexpr double kPlotMargin = 14, kRow = 27;

struct LegendBox {
  Point low, high;  // in pixels
};

std::size_t points_in(const LegendBox& box, const Frame& frame, const FreePathPlot& plot) {
  std::size_t count = 0;
  for (const PlotSeries& series : plot.series)
    for (const MeasuredPoint& point : series.points) {
      if (!frame.can_show(point)) continue;
      const Point at = frame(point.t, point.value);
      count += at.x > box.low.x - 8 && at.x < box.high.x + 8 && at.y > box.low.y - 8 && at.y < box.high.y + 8;
    }
  return count;
}

// The legend's place: the corner where it hides the fewest points, which are drawn beneath it.
LegendBox legend_box(const Frame& frame, const FreePathPlot& plot) {
  std::size_t longest = 0, rows = plot.series.size();
  for (const PlotSeries& series : plot.series) longest = std::max(longest, letters_in(series.name));
  for (const PlotCurve& curve : plot.curves) {
    longest = std::max(longest, letters_in(curve.name));
    rows += !curve.name.empty();
  }
  const double height = kRow * static_cast<double>(rows) + 10,
               width = 66 + kAdvance * kLetterSize * static_cast<double>(longest), gap = 16,
               left = frame.left + gap, right = frame.right - gap - width, up = frame.top + gap,
               down = frame.bottom - gap - height;
  const Point corners[] = {{left, down}, {right, up}, {left, up}, {right, down}};
  const auto hidden = [&](const Point& corner) {
    return points_in({corner, {corner.x + width, corner.y + height}}, frame, plot);
  };
  const Point best = *std::min_element(std::begin(corners), std::end(corners),
                                       [&](const Point& a, const Point& b) { return hidden(a) < hidden(b); });
  return {best, {best.x + width, best.y + height}};
}

void add_plot_legend(Svg& svg, const Frame& frame, const FreePathPlot& plot) {
  const LegendBox box = legend_box(frame, plot);
  const double left = box.low.x;
  svg.rectangle(box.low, box.high, "fill=\"white\" fill-opacity=\"0.85\" stroke=\"#bbbbbb\"");
  double y = box.low.y + 5 + kRow / 2;
  const auto label = [&](const std::string& words) {
    svg.text({left + 56, y + 7}, words);
    y += kRow;
  };
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    add_marker(svg, {left + 28, y}, i);
    label(plot.series[i].name);
  }
  for (const PlotCurve& curve : plot.curves) {
    if (curve.name.empty()) continue;
    svg.polyline({{left + 10, y}, {left + 46, y}}, style_of(curve));
    label(curve.name);
  }
}

// Adds a text, in a font small enough to fit.
void add_words(Svg& svg, Point at, const std::string& words, double size, double room, const char* style) {
  const double fits = room / (kAdvance * static_cast<double>(std::max<std::size_t>(1, letters_in(words))));
  svg.text(at, words, fmt::format("font-size=\"{:.1f}\" {}", std::min(size, fits), style));
}

}  // namespace

std::string draw_free_paths(const FreePathPlot& plot) {
  Frame frame;
  frame.t.axes = frame.value.axes = plot.axes;
  set_ranges(plot, frame);
  frame.left = 100;
  frame.right = plot.width - 2 * kPlotMargin;
  frame.top = plot.title.empty() ? 2 * kPlotMargin : 50;
  frame.bottom = plot.height - (plot.note.empty() ? 72 : 100);
  Svg svg;
  svg.raw(
      fmt::format("<defs><clipPath id=\"frame\"><rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" "
                  "height=\"{:.2f}\"/></clipPath></defs>\n",
                  frame.left, frame.top, frame.right - frame.left, frame.bottom - frame.top));
  svg.open(fmt::format("font-size=\"{}\"", kLetterSize));
  add_axes(svg, frame, plot);
  for (const PlotCurve& curve : plot.curves) add_curve(svg, frame, curve);
  for (std::size_t i = 0; i < plot.series.size(); ++i) add_series(svg, frame, plot.series[i], i);
  add_plot_legend(svg, frame, plot);
  if (!plot.title.empty())
    add_words(svg, {frame.left, 33}, plot.title, 22, frame.right - frame.left, "font-weight=\"bold\"");
  if (!plot.note.empty())
    add_words(svg, {kPlotMargin, plot.height - kPlotMargin}, plot.note, 17, plot.width - 2 * kPlotMargin,
              "fill=\"#444444\"");
  svg.close();
  return svg.document(plot.width, plot.height, plot.title);
}

}  // namespace lorentz::pictures
