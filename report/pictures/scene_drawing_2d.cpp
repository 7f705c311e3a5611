// Pictures of 2D scenes, as a window on the plane.
#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "report/pictures/drawing_parts.hpp"

namespace lorentz::pictures {
namespace {

std::array<Vec, 4> corners_of(const Scene& scene, const Vec& corner) {
  const auto& u = scene.lattices[0].vectors;
  return {corner, sum(corner, u[0]), sum(sum(corner, u[0]), u[1]), sum(corner, u[1])};
}

// Half the width of about 4 by 4 cells; less if these would hold too many obstacles.
double half_width(const Scene& scene) {
  const double cell = cell_size(scene);
  double expected = 0;
  for (const Lattice& lattice : scene.lattices)
    expected += static_cast<double>(lattice.atoms.size()) * 16 * cell * cell / cell_volume(lattice, 2);
  return 2 * cell * std::min(1.0, std::sqrt(static_cast<double>(kMostDrawn) / expected));
}

// The box of these cells, or of all flights that end. Flights that go on are cut by the picture, unless there
// are no others.
Extent box_for(const Scene& scene, const Vec& corner, const std::vector<DrawnLine>& lines) {
  const auto& u = scene.lattices[0].vectors;
  const double cell = cell_size(scene);
  const Vec diagonal = sum(u[0], u[1]);
  const bool needle =
      std::hypot(diagonal[0], diagonal[1]) > 6 * cell;  // the cell reaches far beyond the picture
  const Vec middle = plus(corner, needle ? 0 : 0.5, diagonal);
  Extent box{middle, middle};
  box.include(middle, lines.empty() ? half_width(scene) : 0.75 * cell);
  for (const Vec& p : corners_of(scene, corner))
    if (std::hypot(p[0] - middle[0], p[1] - middle[1]) < 3.01 * cell) box.include(p, 0.1 * cell);
  const bool any_ends =
      std::any_of(lines.begin(), lines.end(), [](const DrawnLine& line) { return line.ends; });
  for (const DrawnLine& line : lines) {
    box.include(line.from, 0.6 * cell);
    if (line.ends || !any_ends) box.include(line.to, 0.6 * cell);
  }
  // No thinner than 1 : 4.
  const double wide = box.width(), tall = box.height();
  for (const int k : {0, 1}) {
    const double lacking = (k == 0 ? tall : wide) / 4 - (k == 0 ? wide : tall);
    if (lacking <= 0) continue;
    box.low[k] -= lacking / 2;
    box.high[k] += lacking / 2;
  }
  box.low[2] = box.high[2] = 0;
  return box;
}

// Adds the first lattice's cells, faint, unless there are too many to tell apart.
void add_grid(Svg& svg, const Scene& scene, const PaperWindow& window, const Vec& corner) {
  const auto& u = scene.lattices[0].vectors;
  const auto rows = dual_of(u, 2);
  const double reach = window.box.diagonal();
  constexpr double kMostLines = 100;
  for (const int i : {0, 1}) {
    const Vec &along = u[i], &across = u[1 - i];
    const double count = std::ceil(reach * std::sqrt(dot(rows[1 - i], rows[1 - i])));
    if (count > kMostLines) return;
    const double share =
        reach / std::sqrt(dot(along, along)) + count * std::fabs(dot(along, across)) / dot(along, along);
    for (double n = -count; n <= count; ++n) {
      const Vec base = plus(corner, n, across);
      svg.polyline({window(plus(base, -share, along)), window(plus(base, share, along))},
                   "stroke=\"#dcdcdc\" stroke-width=\"0.8\"");
    }
  }
}

void add_disc(Svg& svg, const Scene& scene, const PaperWindow& window, const Placed& obstacle, bool hit,
              bool& enlarged) {
  constexpr double kSmallest = 2;
  const Atom& atom = scene.lattices[obstacle.lattice].atoms[obstacle.atom];
  const EllipseShape seen = shadow_of(atom, 2, {1, 0, 0}, {0, 1, 0}),
                     shape = to_scale(seen, window.scale, kSmallest);
  enlarged |= seen.rx * window.scale < kSmallest;
  const Colour& c = colour(colour_index(scene, obstacle));
  const double line = std::min(1.2, 0.25 * shape.rx + 0.1);
  svg.ellipse(window(obstacle.centre), shape,
              hit ? fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"2\"", c.fill, kFlightColour)
                  : fmt::format("fill=\"{}\" fill-opacity=\"0.7\" stroke=\"{}\" stroke-width=\"{:.2f}\"",
                                c.fill, c.dark, line));
}

// The part of a segment that is in the box, as fractions of its length; false if there is none.
bool part_in(const Extent& box, const Vec& from, const Vec& to, double& first, double& last) {
  first = 0, last = 1;
  for (const int k : {0, 1}) {
    const double step = to[k] - from[k];
    if (step == 0) {
      if (from[k] < box.low[k] || from[k] > box.high[k]) return false;
      continue;
    }
    const double a = (box.low[k] - from[k]) / step, b = (box.high[k] - from[k]) / step;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

// Adds the part of a flight in the window; an arrow if it goes on beyond.
void add_way(Svg& svg, const PaperWindow& window, const DrawnLine& line, Legend& legend) {
  const Extent& box = window.box;
  Vec to = line.to;
  if (!line.ends) {  // goes on to a point beyond the window
    const Vec& v = line.flight->query.v;
    const Vec start = plus(line.from, -1, box.centre());
    const double speed = std::hypot(v[0], v[1]), reach = box.diagonal() + std::hypot(start[0], start[1]);
    to = plus(line.from, reach, {v[0] / speed, v[1] / speed, 0});
  }
  double first = 0, last = 1;
  if (!part_in(box, line.from, to, first, last)) return;
  const Vec way = plus(to, -1, line.from);
  const Point start = window(plus(line.from, first, way)), end = window(plus(line.from, last, way));
  const std::string stroke = fmt::format("stroke=\"{}\" stroke-width=\"1.4\"", kFlightColour);
  if (last < 1 || !line.ends) {
    svg.arrow(start, end, 11, kFlightColour, 1.4);
    (line.flight->answer.outcome == Outcome::never ? legend.never : legend.goes_on) = true;
  } else {
    svg.polyline({start, end}, stroke);
    svg.ellipse(end, {2.6, 2.6, 0}, fmt::format("fill=\"{}\"", kFlightColour));
    (line.flight->answer.outcome == Outcome::inside ? legend.inside : legend.hits) = true;
  }
  if (first == 0) svg.ellipse(start, {3, 3, 0}, fmt::format("fill=\"white\" {}", stroke));
}

// Adds a corridor, with its translates if there is only one lattice: strips at distances of area / |vector|.
bool add_corridor(Svg& svg, const Scene& scene, const PaperWindow& window, const FreeWay& way,
                  const char* colour) {
  const double length = std::hypot(way.vector[0], way.vector[1]);
  const Vec along{way.vector[0] / length, way.vector[1] / length, 0}, across{-along[1], along[0], 0};
  const Extent& box = window.box;
  const Vec arm = plus(box.centre(), -1, way.point);
  const double reach = box.diagonal() / 2;
  const double reach_across =
      (std::fabs(across[0]) * box.width() + std::fabs(across[1]) * box.height() + way.width) / 2;
  const double period = scene.lattices.size() == 1 ? cell_volume(scene.lattices[0], 2) / length : 0;
  constexpr double kMostStrips = 60;
  double first = 0, last = 0;
  if (period > 0 && 2 * reach / period < kMostStrips) {
    first = std::ceil((dot(arm, across) - reach_across) / period);
    last = std::floor((dot(arm, across) + reach_across) / period);
  }
  for (double n = first; n <= last; ++n) {
    const Vec middle = plus(plus(way.point, n * period, across), dot(arm, along), along);
    const auto corner = [&](double share, double side) {
      return window(plus(plus(middle, share * reach, along), side * way.width / 2, across));
    };
    svg.polygon({corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)},
                fmt::format("fill=\"{0}\" fill-opacity=\"0.2\" stroke=\"{0}\" stroke-opacity=\"0.6\" "
                            "stroke-width=\"0.8\"",
                            colour));
  }
  return first < last || std::fabs(dot(arm, across) - first * period) < reach_across;
}

class Picture2D {
 public:
  Picture2D(const Scene& scene, const DrawOptions& options, const std::vector<DrawnFlight>& flights)
      : scene_(scene), options_(options) {
    lines_ = options.window ? lines_in_window(scene, flights) : lines_of(scene, flights, drawing_.remarks);
    if (options.window) {
      const auto [x0, y0, x1, y1] = *options.window;
      window_.box = {{x0, y0, 0}, {x1, y1, 0}};
      corner_ = cell_at(scene, scene.lattices[0].vectors, window_.box.centre());
    } else {
      corner_ = cell_at(scene, scene.lattices[0].vectors, lines_.empty() ? Vec{} : lines_[0].from);
      window_.box = box_for(scene, corner_, lines_);
    }
    choose_obstacles();
    for (const Vec& p : corners_of(scene, corner_))
      if (window_.box.contains(p, 0) && scene.lattices[0].rank >= 2)
        legend_.cell = scene.lattices.size() > 1 ? "a cell of lattice 0" : "a primitive cell";
  }

  Drawing draw() {
    constexpr double kTallest = 1000;
    legend_.notes = drawing_.remarks;
    Legend about = legend_;  // with everything that may be added
    about.hits = about.goes_on = !lines_.empty();
    for (std::size_t i = 0; i < options_.ways.size(); ++i) about.ways.push_back(i);
    // The picture is as large as the page allows, in its middle.
    const Page page(scene_, options_, about, kTallest);
    window_.scale = std::min(page.width / window_.box.width(), page.height / window_.box.height());
    window_.left = kMargin + (page.width - window_.width()) / 2;
    window_.top = page.top;
    const Point low = window_({window_.box.low[0], window_.box.high[1], 0});
    svg_.raw(
        fmt::format("<clipPath id=\"window\"><rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" "
                    "height=\"{:.2f}\"/></clipPath>\n",
                    low.x, low.y, window_.width(), window_.height()));
    svg_.open("clip-path=\"url(#window)\"");
    add_contents();
    svg_.close();
    const double right = low.x + window_.width(), bottom = low.y + window_.height();
    svg_.rectangle(low, {right, bottom}, "fill=\"none\" stroke=\"#aaaaaa\"");
    if (enlarged_) legend_.notes.push_back("The obstacles are smaller than they are drawn.");
    drawing_.svg = finished(svg_, scene_, options_, legend_, bottom);
    return std::move(drawing_);
  }

 private:
  void choose_obstacles() {
    bool cut = false;
    obstacles_ = obstacles_in(scene_, window_.box, cut);
    const bool from_middle = lines_.empty() || options_.window;
    thin_out(obstacles_, from_middle ? window_.box.centre() : lines_[0].from, drawing_.remarks);
    if (cut) drawing_.remarks.push_back("some lattices are too fine for this picture and left out");
    for (const Placed& hit : hits_of(scene_, lines_)) {
      const Atom& atom = scene_.lattices[hit.lattice].atoms[hit.atom];
      if (window_.box.contains(hit.centre, principal_semiaxes(atom, 2)[0])) hits_.push_back(hit);
    }
    for (const auto* some : {&obstacles_, &hits_})
      for (const Placed& obstacle : *some) legend_.atoms.insert({obstacle.lattice, obstacle.atom});
  }

  void add_contents() {
    if (scene_.lattices[0].rank >= 2) add_grid(svg_, scene_, window_, corner_);
    for (std::size_t i = 0; i < options_.ways.size(); ++i)
      if (add_corridor(svg_, scene_, window_, options_.ways[i], way_colour(i))) legend_.ways.push_back(i);
    for (const Placed& obstacle : obstacles_) add_disc(svg_, scene_, window_, obstacle, false, enlarged_);
    for (const Placed& obstacle : hits_) add_disc(svg_, scene_, window_, obstacle, true, enlarged_);
    const auto corners = corners_of(scene_, corner_);
    if (!legend_.cell.empty())
      svg_.polygon({window_(corners[0]), window_(corners[1]), window_(corners[2]), window_(corners[3])},
                   "fill=\"none\" stroke=\"#222222\" stroke-width=\"1.6\" stroke-linejoin=\"round\"");
    for (const DrawnLine& line : lines_) add_way(svg_, window_, line, legend_);
  }

  const Scene& scene_;
  const DrawOptions& options_;
  Drawing drawing_;
  Svg svg_;
  Legend legend_;
  std::vector<DrawnLine> lines_;
  std::vector<Placed> obstacles_, hits_;
  PaperWindow window_;
  Vec corner_{};
  bool enlarged_ = false;
};

}  // namespace

Drawing draw_scene_2d(const Scene& scene, const DrawOptions& options,
                      const std::vector<DrawnFlight>& flights) {
  return Picture2D(scene, options, flights).draw();
}

}  // namespace lorentz::pictures
