// The panel of the flight: its start, its end according to each answer, and the obstacles beside it. A long
// flight is broken; all stretches have the same scale.
#include <algorithm>
#include <cmath>

#include "report/pictures/finding_parts.hpp"

namespace lorentz::pictures {
namespace {

using oracle::PlaceOnLine;

constexpr double kWhole = 20;                 // cells: a flight up to this length is not broken
constexpr double kTogether = 5;               // cells: places nearer than this share a stretch
constexpr double kBreak = 46;                 // pixels: width of a zigzag
constexpr std::size_t kMostLookedAt = 1000;   // obstacles of an atom beside a part of the line
constexpr std::size_t kMostNeighbours = 400;  // drawn in a stretch
constexpr double kSmallestDot = 2;            // pixels: radius of an obstacle

// A part of the line, by distances from its anchor, and on paper.
struct LineStretch {
  PlaceOnLine anchor;
  double low = 0, high = 0, left = 0;
};

class FlightDrawing {
 public:
  FlightDrawing(Svg& svg, const FindingCase& finding, const Panel& panel)
      : svg_(svg), case_(finding), panel_(panel), cell_(cell_size(finding.scene)) {}

  FlightPanel draw() {
    lay_out();
    for (const LineStretch& stretch : stretches_) add_stretch(stretch);
    add_breaks();
    add_ends();
    add_compass();
    if (case_.issue != Issue::none) result_.at = on_line(case_.place());
    if (result_.at && case_.issue == Issue::line && case_.distance < 0)  // in the middle of the chord
      result_.at->x += std::sqrt(-case_.distance * (2 + case_.distance)) * result_.scale / case_.in_radii(1);
    if (leaves_) result_.notes.push_back("Dashed: the obstacle that the flight leaves.");
    if (enlarged_) result_.notes.push_back("Obstacles are smaller than they are drawn.");
    if (incomplete_) result_.notes.push_back("There are more obstacles than are drawn.");
    if (case_.scene.dimension == 3)
      result_.notes.push_back(
          "Above: the plane of the flight and the obstacle's centre; dotted: in front or behind.");
    return std::move(result_);
  }

 private:
  // The places, in order along the line.
  std::vector<PlaceOnLine> places() const {
    std::vector<PlaceOnLine> places{PlaceOnLine::start()};
    for (const Answer* answer : {&case_.exact, case_.given})
      if (answer)
        if (auto end = case_.end_of(*answer)) places.push_back(*end);
    if (case_.issue != Issue::none) places.push_back(case_.place());
    if (case_.second) places.push_back(PlaceOnLine::at(*case_.second));
    std::sort(places.begin(), places.end(),
              [&](const PlaceOnLine& a, const PlaceOnLine& b) { return way(b, a) < 0; });
    return places;
  }

  // Places that are close together share a stretch; in a short flight all do.
  void lay_out() {
    const std::vector<PlaceOnLine> all = places();
    const bool whole = way(all.front(), all.back()) <= kWhole * cell_;
    const double margin = 0.7 * cell_;
    for (const PlaceOnLine& place : all) {
      const double from_last = stretches_.empty() ? 0 : way(stretches_.back().anchor, place);
      if (!stretches_.empty() && (whole || from_last + margin - stretches_.back().high < kTogether * cell_))
        stretches_.back().high = std::max(stretches_.back().high, from_last + margin);
      else
        stretches_.push_back({place, -margin, margin, 0});
    }
    widen();
  }

  // Makes the scale as large as the panel allows, but keeps at least a cell and a half visible across the
  // flight.
  void widen() {
    const double n = static_cast<double>(stretches_.size());
    const double room = panel_.width - kBreak * (n - 1);
    double total = 0;
    for (const LineStretch& stretch : stretches_) total += stretch.high - stretch.low;
    result_.scale = std::min(room / total, panel_.height / (1.5 * cell_));
    const double more = (room / result_.scale - total) / (2 * n);
    double left = panel_.left;
    for (LineStretch& stretch : stretches_) {
      stretch.low -= more;
      stretch.high += more;
      stretch.left = left;
      left += (stretch.high - stretch.low) * result_.scale + kBreak;
    }
  }

  std::optional<Point> on_line(const PlaceOnLine& place) const {
    for (const LineStretch& stretch : stretches_) {
      const double at = way(stretch.anchor, place);
      if (at >= stretch.low && at <= stretch.high)
        return Point{stretch.left + (at - stretch.low) * result_.scale, panel_.middle()};
    }
    return std::nullopt;
  }

  // Adds an ellipse about a point, in the unit of length; a dot if the obstacle is too small to be seen.
  void add_ellipse(Point at, const ShapeSection& ellipse, const std::string& style, const std::string& hint,
                   bool is_dot) {
    const double size = result_.scale;
    const EllipseShape shape =
        is_dot ? EllipseShape{kSmallestDot, kSmallestDot, 0} : to_scale(ellipse.shape, size);
    enlarged_ |= is_dot;
    svg_.ellipse({on_paper(at.x + size * ellipse.centre.x), on_paper(at.y - size * ellipse.centre.y)},
                 {on_paper(shape.rx), on_paper(shape.ry), shape.angle}, style, hint);
  }

  // Adds the obstacles beside the flight, faint. They are searched in balls along it; each ball takes those
  // beside its own part of the line. Obstacles that begin before a stretch may reach into it.
  void add_neighbours(const LineStretch& stretch) {
    double largest = 0;  // radius
    for_each_atom(case_.scene, [&](const Atom& atom) {
      largest = std::max(largest, principal_semiaxes(atom, case_.scene.dimension)[0]);
    });
    const double margin = std::min(largest, cell_);
    const double half_height = panel_.height / 2 / result_.scale + margin;
    const double low = stretch.low - margin, high = stretch.high + margin;
    const double pieces = std::ceil((high - low) / (2 * half_height)), half = (high - low) / (2 * pieces);
    svg_.open(paint(kFaintInk, kFaintInk, 0.8) + " fill-opacity=\"0.22\"");
    std::size_t drawn = 0;
    for (double piece = 0; piece < pieces; ++piece) {
      PlaceOnLine middle = stretch.anchor;
      middle.beyond = low + (2 * piece + 1) * half;
      const auto found =
          case_.surroundings.around(case_.query, middle, std::hypot(half, half_height), kMostLookedAt);
      incomplete_ |= !found.complete;
      for (const oracle::Neighbour& one : found.obstacles) {
        const double along = dot(one.centre, case_.along);
        if (along < -half || along >= half || ink_of(case_, one.obstacle)) continue;
        const Vec centre = sum(one.centre, scaled(case_.along, middle.beyond));
        if (drawn < kMostNeighbours)
          drawn += add_neighbour(stretch, one.obstacle, centre);
        else
          incomplete_ = true;
      }
    }
    svg_.close();
  }

  // In 3D an obstacle is drawn only if the plane of the drawing cuts it, or as a shadow if it is near the
  // plane. True if it was drawn.
  bool add_neighbour(const LineStretch& stretch, const ObstacleId& id, const Vec& centre) {
    const Point at = on_paper_of(stretch, centre);
    const Atom& atom = case_.atom_of(id);
    const ShapeSection shadow{{0, 0}, shadow_of(atom, case_.scene.dimension, case_.along, case_.across)};
    const double radius = shadow.shape.rx * result_.scale;
    if (at.y < panel_.top - radius || at.y > panel_.bottom() + radius) return false;
    const double depth = dot(centre, case_.depth);
    const bool is_dot = radius < kSmallestDot;
    const bool is_left = case_.query.from == id;
    const std::string name = case_.name_of(id) + (is_left ? ", which the flight leaves" : "");
    const std::string style = is_left ? "stroke-width=\"2\" stroke-dasharray=\"7 3\"" : "";
    leaves_ |= is_left;
    if (case_.scene.dimension == 2) {
      add_ellipse(at, shadow, style, name, is_dot);
    } else if (const auto section = section_of(case_, atom, depth)) {
      add_ellipse(at, *section, style, name, is_dot);
    } else if (std::fabs(depth) < cell_ / 2) {
      add_ellipse(at, shadow, is_dot ? "fill-opacity=\"0\"" : "fill-opacity=\"0\" stroke-dasharray=\"2 3\"",
                  name + (depth > 0 ? ", in front" : ", behind"), is_dot);
    } else {
      return false;
    }
    return true;
  }

  // Adds an obstacle that an answer names, or that is in question.
  void add_obstacle(const LineStretch& stretch, const ObstacleId& id, const Vec& centre) {
    const Point at = on_paper_of(stretch, centre);
    if (!(std::fabs(at.x) < 1e4 && std::fabs(at.y) < 1e4)) return;
    const Ink ink = *ink_of(case_, id);
    const Atom& atom = case_.atom_of(id);
    const ShapeSection shadow{{0, 0}, shadow_of(atom, case_.scene.dimension, case_.along, case_.across)};
    const std::string filled = paint(ink, ink, 1.5) + " fill-opacity=\"0.3\"";
    const std::string hint = hint_of(case_, id);
    const bool is_dot = shadow.shape.rx * result_.scale < kSmallestDot;
    if (case_.scene.dimension == 2) return add_ellipse(at, shadow, filled, hint, is_dot);
    add_ellipse(at, shadow, paint(ink, ink, 0.8) + " fill-opacity=\"0.05\" stroke-dasharray=\"2 3\"", hint,
                is_dot);
    if (const auto section = section_of(case_, atom, dot(centre, case_.depth)))
      add_ellipse(at, *section, filled, hint, is_dot);
  }

  void add_line(const LineStretch& stretch, const Answer& answer, const std::string& style, Ink ink) {
    if (answer.outcome != Outcome::hit && answer.outcome != Outcome::never) return;
    const auto end = case_.end_of(answer);
    if (answer.outcome == Outcome::hit && !end) return;
    const double from = std::max(stretch.low, way(stretch.anchor, PlaceOnLine::start()));
    const double to = end ? std::min(stretch.high, way(stretch.anchor, *end)) : stretch.high;
    if (!(from < to)) return;
    const auto at = [&](double place) {
      return Point{on_paper(stretch.left + (place - stretch.low) * result_.scale), panel_.middle()};
    };
    svg_.polyline({at(from), at(to)}, style);
    if (answer.outcome == Outcome::never && &stretch == &stretches_.back())
      svg_.polygon({{at(to).x, at(to).y}, {at(to).x - 12, at(to).y - 5}, {at(to).x - 12, at(to).y + 5}},
                   paint(ink));
  }

  void add_stretch(const LineStretch& stretch) {
    const Panel window{stretch.left, panel_.top, (stretch.high - stretch.low) * result_.scale, panel_.height};
    open_clip(svg_, window);
    add_neighbours(stretch);
    for (const ObstacleId& id : marked_obstacles(case_))
      add_obstacle(stretch, id, case_.surroundings.centre(case_.query, stretch.anchor, id));
    add_line(stretch, case_.exact, outline(kExactInk, 2.6), kExactInk);
    if (case_.given) add_line(stretch, *case_.given, outline(kGivenInk, 1.8) + kGivenDashes, kGivenInk);
    close_clip(svg_);
  }

  // Adds a zigzag between stretches, with the number of cells left out.
  void add_breaks() {
    for (std::size_t i = 1; i < stretches_.size(); ++i) {
      const LineStretch &before = stretches_[i - 1], &after = stretches_[i];
      const double cells = (way(before.anchor, after.anchor) + after.low - before.high) / cell_;
      const double x = after.left - kBreak / 2, y = panel_.middle();
      open_hint(svg_, fmt::format("{:.6g} cells of the flight are left out", cells));
      for (const double side : {-6.0, 6.0}) {
        std::vector<Point> zigzag;
        const int teeth = static_cast<int>(panel_.height / 20) - 1;
        for (int k = -teeth; k <= teeth; ++k)
          zigzag.push_back({x + side + (k % 2 == 0 ? -3 : 3), y - 8 + 10.0 * k});
        svg_.polyline(zigzag, outline(kFaintInk, 1));
      }
      svg_.close();
      svg_.text({x, panel_.bottom() - 2}, fmt::format("{:.3g} cells", cells),
                paint(kInk) + " text-anchor=\"middle\" font-size=\"10\"");
    }
  }

  // Adds the axes of the scene, as they are turned in the drawing.
  void add_compass() {
    constexpr double kArm = 16;
    const Point middle{panel_.left + 22, panel_.top + 20};
    svg_.open(fmt::format("color=\"{1}\" style=\"color:var({0},{1})\"", kInk.variable, kInk.otherwise));
    svg_.ellipse(middle, {20, 20, 0}, paint(kPaper) + " fill-opacity=\"0.8\"");
    for (int k = 0; k < case_.scene.dimension; ++k) {
      const double x = case_.along[k], y = case_.across[k];
      if (std::hypot(x, y) < 0.25) continue;  // it points towards the reader
      svg_.arrow(middle, {middle.x + kArm * x, middle.y - kArm * y}, 5, "currentColor", 1);
      svg_.text({middle.x + 1.5 * kArm * x - 3, middle.y - 1.5 * kArm * y + 3}, std::string(1, "xyz"[k]),
                paint(kInk) + " font-size=\"10\"");
    }
    svg_.close();
  }

  void add_ends() {
    const auto add = [&](const Answer& answer, Ink ink, bool cross) {
      const auto end = case_.end_of(answer);
      const auto at = end ? on_line(*end) : std::nullopt;
      if (!at) return;
      open_hint(svg_, fmt::format("{}: {:.9g} of length from the start", cross ? "given" : "exact",
                                  std::ldexp(way(PlaceOnLine::start(), *end), case_.exponent)));
      if (cross) {
        svg_.polyline({{at->x - 5, at->y - 5}, {at->x + 5, at->y + 5}}, outline(ink, 2));
        svg_.polyline({{at->x - 5, at->y + 5}, {at->x + 5, at->y - 5}}, outline(ink, 2));
      } else {
        svg_.ellipse(*at, {4, 4, 0}, paint(ink));
      }
      svg_.close();
    };
    if (const auto start = on_line(PlaceOnLine::start())) {
      open_hint(svg_, "the start");
      svg_.ellipse(*start, {4, 4, 0}, paint(kPaper, kInk, 1.5));
      svg_.close();
    }
    add(case_.exact, kExactInk, false);
    if (case_.given) add(*case_.given, kGivenInk, true);
  }

  double way(const PlaceOnLine& from, const PlaceOnLine& to) const {
    return case_.surroundings.way(case_.query, from, to);
  }
  Point on_paper_of(const LineStretch& stretch, const Vec& place) const {
    return {stretch.left + (dot(place, case_.along) - stretch.low) * result_.scale,
            panel_.middle() - dot(place, case_.across) * result_.scale};
  }

  Svg& svg_;
  const FindingCase& case_;
  const Panel panel_;
  const double cell_;
  std::vector<LineStretch> stretches_;
  FlightPanel result_;
  bool enlarged_ = false, incomplete_ = false, leaves_ = false;
};

}  // namespace

FlightPanel draw_flight(Svg& svg, const FindingCase& finding, const Panel& panel) {
  return FlightDrawing(svg, finding, panel).draw();
}

// The view along the flight, which appears as a point, with the shadows of the obstacles around it.
void draw_side_view(Svg& svg, const FindingCase& finding, const Panel& panel) {
  const auto shadow_along = [&](const ObstacleId& id) {
    const Vec centre = finding.surroundings.centre(finding.query, PlaceOnLine::at(id), id);
    return ShapeSection{{dot(centre, finding.depth), dot(centre, finding.across)},
                        shadow_of(finding.atom_of(id), 3, finding.depth, finding.across)};
  };
  double reach = 0;
  for (const ObstacleId& id : marked_obstacles(finding)) {
    const ShapeSection one = shadow_along(id);
    reach = std::max(reach, std::max(std::fabs(one.centre.x), std::fabs(one.centre.y)) + one.shape.rx);
  }
  if (!(reach > 0) || !std::isfinite(reach)) return;
  const double scale = 0.95 * panel.height / 2 / reach;
  const Point middle{panel.left + panel.width / 2, panel.middle()};
  open_clip(svg, panel);
  for (const ObstacleId& id : marked_obstacles(finding)) {
    const ShapeSection one = shadow_along(id);
    const Ink ink = *ink_of(finding, id);
    svg.ellipse({on_paper(middle.x + scale * one.centre.x), on_paper(middle.y - scale * one.centre.y)},
                {on_paper(std::max(1.0, scale * one.shape.rx)), on_paper(std::max(1.0, scale * one.shape.ry)),
                 -one.shape.angle},
                paint(ink, ink, 1.2) + " fill-opacity=\"0.2\"", hint_of(finding, id));
  }
  svg.ellipse(middle, {2.5, 2.5, 0}, paint(kInk), "the line of the flight, seen along it");
  close_clip(svg);
  frame(svg, panel, outline(kFaintInk, 0.8));
  svg.text({panel.left, panel.top - 4}, "along the flight", paint(kInk) + " font-size=\"10\"");
}

}  // namespace lorentz::pictures
