// Pictures of 2D scenes: a window on the plane.
#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "pictures/drawing_parts.hpp"

namespace lorentz::pictures {
namespace {

constexpr double kTallest = 1000;

// The plane on paper: y upwards.
struct Window {
  Box box;
  double scale = 1;  // pixels per unit of length

  Point operator()(const Vec& p) const {
    return {kMargin + scale * (p[0] - box.low[0]), kTitleHeight + scale * (box.high[1] - p[1])};
  }
  double width() const { return scale * (box.high[0] - box.low[0]); }
  double height() const { return scale * (box.high[1] - box.low[1]); }
};

Vec plus(const Vec& a, const Vec& b, double share = 1) {
  return {a[0] + share * b[0], a[1] + share * b[1], a[2] + share * b[2]};
}

// About 4 by 4 cells around `corner`'s, smaller if that held too many obstacles, and all of the flights.
Window window_for(const Scene& scene, const Vec& corner, const std::vector<Line>& lines) {
  const auto& u = scene.lattices[0].vectors;
  const double cell = cell_size(scene);
  double expected = 0;
  for (const Lattice& lattice : scene.lattices)
    expected += static_cast<double>(lattice.atoms.size()) * 16 * cell * cell / cell_volume(lattice, 2);
  const double half = 2 * cell * std::min(1.0, std::sqrt(static_cast<double>(kMostDrawn) / expected));
  const Vec diagonal = plus(u[0], u[1]);
  const bool needle =
      std::hypot(diagonal[0], diagonal[1]) > 6 * cell;  // the cell reaches far beyond the picture
  const Vec middle = plus(corner, diagonal, needle ? 0 : 0.5);
  Window window;
  window.box = {middle, middle};
  if (lines.empty())
    window.box.include(middle, half);
  else
    window.box.include(middle, 0.75 * cell);
  for (const Vec& p : {corner, plus(corner, u[0]), plus(corner, u[1]), plus(plus(corner, u[0]), u[1])})
    if (std::hypot(p[0] - middle[0], p[1] - middle[1]) < 3.01 * cell) window.box.include(p, 0.1 * cell);
  for (const Line& line : lines) {
    window.box.include(line.from, 0.6 * cell);
    window.box.include(line.to, 0.6 * cell);
  }
  // No thinner than 1 : 4.
  const double wide = window.box.high[0] - window.box.low[0], tall = window.box.high[1] - window.box.low[1];
  for (const int k : {0, 1}) {
    const double lacking = (k == 0 ? tall : wide) / 4 - (k == 0 ? wide : tall);
    if (lacking <= 0) continue;
    window.box.low[k] -= lacking / 2;
    window.box.high[k] += lacking / 2;
  }
  window.box.low[2] = window.box.high[2] = 0;
  window.scale = std::min((kPictureWidth - 2 * kMargin) / (window.box.high[0] - window.box.low[0]),
                          kTallest / (window.box.high[1] - window.box.low[1]));
  return window;
}

// The first lattice's cells, faint, unless there are too many to tell apart.
void add_grid(Svg& svg, const Scene& scene, const Window& window, const Vec& corner) {
  const auto& u = scene.lattices[0].vectors;
  const auto rows = dual_of(u, 2);
  const double reach =
      std::hypot(window.box.high[0] - window.box.low[0], window.box.high[1] - window.box.low[1]);
  constexpr double kMostLines = 100;
  for (const int i : {0, 1}) {
    const Vec &along = u[i], &across = u[1 - i];
    const double count = std::ceil(reach * std::sqrt(dot(rows[1 - i], rows[1 - i])));
    if (count > kMostLines) return;
    const double share =
        reach / std::sqrt(dot(along, along)) + count * std::fabs(dot(along, across)) / dot(along, along);
    for (double n = -count; n <= count; ++n) {
      const Vec base = plus(corner, across, n);
      svg.polyline({window(plus(base, along, -share)), window(plus(base, along, share))},
                   "stroke=\"#dcdcdc\" stroke-width=\"0.8\"");
    }
  }
}

void add_obstacle(Svg& svg, const Scene& scene, const Window& window, const Placed& obstacle, bool hit,
                  bool& enlarged) {
  constexpr double kSmallest = 2;
  const Atom& atom = scene.lattices[obstacle.lattice].atoms[obstacle.atom];
  const auto columns = semiaxes_of(atom, 2);
  EllipseShape shape = ellipse_of({columns[0][0], columns[1][0], 0}, {columns[0][1], columns[1][1], 0});
  shape = {shape.rx * window.scale, shape.ry * window.scale, -shape.angle};
  if (shape.rx < kSmallest) {
    shape = {kSmallest, kSmallest, 0};
    enlarged = true;
  }
  const Colour& c = colour(colour_index(scene, obstacle));
  const double line = std::min(1.2, 0.25 * shape.rx + 0.1);
  svg.ellipse(window(obstacle.centre), shape,
              hit ? fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"2\"", c.fill, kFlightColour)
                  : fmt::format("fill=\"{}\" fill-opacity=\"0.7\" stroke=\"{}\" stroke-width=\"{:.2f}\"",
                                c.fill, c.dark, line));
}

void add_cell(Svg& svg, const Scene& scene, const Window& window, const Vec& corner) {
  const auto& u = scene.lattices[0].vectors;
  svg.polygon({window(corner), window(plus(corner, u[0])), window(plus(plus(corner, u[0]), u[1])),
               window(plus(corner, u[1]))},
              "fill=\"none\" stroke=\"#222222\" stroke-width=\"1.6\" stroke-linejoin=\"round\"");
}

// Where the ray from `from` towards `to` leaves the window.
Vec leaving(const Window& window, const Vec& from, const Vec& to) {
  double share = 1e300;
  for (const int k : {0, 1}) {
    const double step = to[k] - from[k];
    if (step != 0)
      share = std::min(share, ((step > 0 ? window.box.high[k] : window.box.low[k]) - from[k]) / step);
  }
  return plus(from, plus(to, from, -1), std::max(share, 0.0));
}

void add_flight(Svg& svg, const Window& window, const Line& line) {
  const std::string stroke = fmt::format("stroke=\"{}\" stroke-width=\"1.4\"", kFlightColour);
  const Point from = window(line.from);
  if (!line.ends) {
    svg.arrow(from, window(leaving(window, line.from, line.to)), 11, kFlightColour, 1.4);
  } else {
    svg.polyline({from, window(line.to)}, stroke);
    svg.ellipse(window(line.to), {2.6, 2.6, 0}, fmt::format("fill=\"{}\"", kFlightColour));
  }
  svg.ellipse(from, {3, 3, 0}, fmt::format("fill=\"white\" {}", stroke));
}

}  // namespace

Drawing draw_scene_2d(const Scene& scene, const std::string& title, const std::vector<Flight>& flights) {
  Drawing drawing;
  const std::vector<Line> lines = lines_of(scene, flights, drawing.remarks);
  const Vec corner = lines.empty() ? Vec{} : cell_at(scene, lines[0].from);
  const Window window = window_for(scene, corner, lines);
  bool cut = false, enlarged = false;
  std::vector<Placed> obstacles = obstacles_in(scene, window.box, cut);
  thin_out(obstacles, lines.empty() ? window.box.centre() : lines[0].from, drawing.remarks);
  if (cut) drawing.remarks.push_back("some lattices are too fine for this picture and left out");
  Svg svg;
  svg.text({kMargin, 25}, title, "font-size=\"16\" font-weight=\"bold\"");
  svg.raw(
      fmt::format("<clipPath id=\"window\"><rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" "
                  "height=\"{:.2f}\"/></clipPath>\n",
                  kMargin, kTitleHeight, window.width(), window.height()));
  svg.open("clip-path=\"url(#window)\"");
  add_grid(svg, scene, window, corner);
  for (const Placed& obstacle : obstacles) add_obstacle(svg, scene, window, obstacle, false, enlarged);
  for (const Placed& obstacle : hits_of(scene, lines))
    add_obstacle(svg, scene, window, obstacle, true, enlarged);
  add_cell(svg, scene, window, corner);
  for (const Line& line : lines) add_flight(svg, window, line);
  svg.close();
  svg.polygon(
      {window({window.box.low[0], window.box.low[1], 0}), window({window.box.high[0], window.box.low[1], 0}),
       window({window.box.high[0], window.box.high[1], 0}),
       window({window.box.low[0], window.box.high[1], 0})},
      "fill=\"none\" stroke=\"#aaaaaa\"");
  std::vector<std::string> notes = drawing.remarks;
  if (enlarged) notes.push_back("The obstacles are smaller than they are drawn.");
  const double bottom = add_legend(svg, scene, kTitleHeight + window.height() + 14, !lines.empty(), notes);
  drawing.svg = svg.document(kPictureWidth, bottom + 6, title);
  return drawing;
}

}  // namespace lorentz::pictures
