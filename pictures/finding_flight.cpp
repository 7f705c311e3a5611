// The panel of the flight: where it starts, where it ends by each answer, and what stands beside it. A long
// flight is broken; its stretches have one scale.
#include <algorithm>
#include <cmath>

#include "pictures/drawing_parts.hpp"
#include "pictures/finding_parts.hpp"

namespace lorentz::pictures {
namespace {

using oracle::PlaceOnLine;

constexpr double kWhole = 20;                 // cells: a flight of so many is not broken
constexpr double kTogether = 5;               // cells: places nearer than this share a stretch
constexpr double kBreak = 46;                 // pixels of a zigzag
constexpr std::size_t kMostNeighbours = 150;  // of an atom in a stretch
constexpr double kSmallest = 2;               // pixels: radius of an obstacle

// A part of the line, in lengths from its anchor, and on paper.
struct Stretch {
  PlaceOnLine anchor;
  double low = 0, high = 0, left = 0;
};

class FlightDrawing {
 public:
  FlightDrawing(Svg& svg, const FindingCase& finding, const Panel& panel)
      : svg_(svg), case_(finding), panel_(panel), axes_(axes_of(finding)), cell_(cell_size(finding.scene)) {}

  FlightPanel draw();

 private:
  std::vector<PlaceOnLine> places() const;
  void lay_out();
  void widen();
  double way(const PlaceOnLine& from, const PlaceOnLine& to) const {
    return case_.surroundings.way(case_.query, from, to);
  }
  std::optional<Point> on_line(const PlaceOnLine& place) const;
  void add_stretch(const Stretch& stretch);
  void add_neighbours(const Stretch& stretch, const Panel& window);
  void add_obstacle(const Stretch& stretch, const ObstacleId& id, const Vec& centre);
  void add_shadow(const Atom& atom, Point at, const std::string& style);
  void add_section(const Atom& atom, Point at, double depth, const std::string& style);
  void add_line(const Stretch& stretch, const Answer& answer, const std::string& style, Ink ink);
  void add_breaks();
  void add_ends();

  Svg& svg_;
  const FindingCase& case_;
  const Panel panel_;
  const Axes axes_;
  const double cell_;
  std::vector<Stretch> stretches_;
  FlightPanel result_;
  bool enlarged_ = false, incomplete_ = false;
};

// In order along the line.
std::vector<PlaceOnLine> FlightDrawing::places() const {
  std::vector<PlaceOnLine> places{PlaceOnLine::start()};
  for (const Answer* answer : {&case_.exact, case_.given})
    if (answer)
      if (auto end = case_.end_of(*answer)) places.push_back(*end);
  if (case_.issue != Issue::none) places.push_back(place_in_question(case_));
  if (case_.second) places.push_back(PlaceOnLine::at(*case_.second));
  std::sort(places.begin(), places.end(),
            [&](const PlaceOnLine& a, const PlaceOnLine& b) { return way(b, a) < 0; });
  return places;
}

// Places that stand together share a stretch, or all do if the flight is short.
void FlightDrawing::lay_out() {
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

// As large as the panel allows: not so large that less than a cell and a half is seen across the flight.
void FlightDrawing::widen() {
  const double n = static_cast<double>(stretches_.size());
  const double room = panel_.width - kBreak * (n - 1);
  double total = 0;
  for (const Stretch& stretch : stretches_) total += stretch.high - stretch.low;
  result_.scale = std::min(room / total, panel_.height / (1.5 * cell_));
  const double more = (room / result_.scale - total) / (2 * n);
  double left = panel_.left;
  for (Stretch& stretch : stretches_) {
    stretch.low -= more;
    stretch.high += more;
    stretch.left = left;
    left += (stretch.high - stretch.low) * result_.scale + kBreak;
  }
}

std::optional<Point> FlightDrawing::on_line(const PlaceOnLine& place) const {
  for (const Stretch& stretch : stretches_) {
    const double at = way(stretch.anchor, place);
    if (at >= stretch.low && at <= stretch.high)
      return Point{stretch.left + (at - stretch.low) * result_.scale, panel_.middle()};
  }
  return std::nullopt;
}

// What stands in the plane of the drawing, faint.
void FlightDrawing::add_neighbours(const Stretch& stretch, const Panel& window) {
  const double half_height = panel_.height / 2 / result_.scale;
  const double reach = std::hypot(std::max(stretch.high, -stretch.low), half_height) + cell_;
  const auto found = case_.surroundings.around(case_.query, stretch.anchor, reach, kMostNeighbours);
  if (!found.complete) incomplete_ = true;
  for (const oracle::Neighbour& one : found.obstacles) {
    if (ink_of(case_, one.obstacle)) continue;
    const Point at{stretch.left + (dot(one.centre, axes_.along) - stretch.low) * result_.scale,
                   panel_.middle() - dot(one.centre, axes_.across) * result_.scale};
    const Atom& atom = case_.atom_of(one.obstacle);
    const double radius = length(atom.is_ball() ? Vec{atom.radius, 0, 0} : atom.semiaxes[0]) * result_.scale;
    if (at.x < window.left - 4 * radius || at.x > window.right() + 4 * radius) continue;
    open_hint(svg_, case_.name_of(one.obstacle));
    add_section(atom, at, dot(one.centre, axes_.depth),
                paint(kFaintInk, kFaintInk, 0.8) + " fill-opacity=\"0.22\"");
    svg_.close();
  }
}

// { M y : |y| < 1 } on paper, M the first two rows of the semiaxes in the drawing's axes.
void FlightDrawing::add_shadow(const Atom& atom, Point at, const std::string& style) {
  const auto columns = semiaxes_of(atom, case_.scene.dimension);
  Vec along{}, across{};
  for (int i = 0; i < 3; ++i) {
    along[i] = dot(axes_.along, columns[i]);
    across[i] = dot(axes_.across, columns[i]);
  }
  EllipseShape shape = ellipse_of(scaled(along, result_.scale), scaled(across, result_.scale));
  if (!(shape.rx >= kSmallest)) {
    enlarged_ = true;
    shape = {kSmallest, kSmallest, 0};
  }
  svg_.ellipse({on_paper(at.x), on_paper(at.y)}, {on_paper(shape.rx), on_paper(shape.ry), -shape.angle},
               style);
}

// The part of it in the plane of the drawing, which passes its centre at -depth; nothing if it misses it.
// With y = B w + q, B the two columns of A^-1 for the drawing's axes: |w - w0|^2_S < 1, S = B^T B / k.
void FlightDrawing::add_section(const Atom& atom, Point at, double depth, const std::string& style) {
  if (case_.scene.dimension == 2) return add_shadow(atom, at, style);
  const auto rows = to_ball(atom, 3);
  const Vec a = mapped(rows, axes_.along), b = mapped(rows, axes_.across),
            q = mapped(rows, scaled(axes_.depth, -depth));
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), det = aa * bb - ab * ab;
  const double aq = dot(a, q), bq = dot(b, q);
  const double x = (ab * bq - bb * aq) / det, y = (ab * aq - aa * bq) / det;  // where it is nearest
  const Vec nearest = sum(q, sum(scaled(a, x), scaled(b, y)));
  const double k = 1 - dot(nearest, nearest);
  if (!(k > 0)) return;
  // w = L^-T u for S = L L^T, |u| < 1.
  const double l11 = std::sqrt(aa / k), l21 = ab / k / l11, l22 = std::sqrt(det / aa / k);
  const double size = result_.scale;
  EllipseShape shape = ellipse_of({size / l11, -size * l21 / (l11 * l22), 0}, {0, size / l22, 0});
  if (!(shape.rx >= kSmallest)) {
    enlarged_ = true;
    shape = {kSmallest, kSmallest, 0};
  }
  svg_.ellipse({on_paper(at.x + size * x), on_paper(at.y - size * y)},
               {on_paper(shape.rx), on_paper(shape.ry), -shape.angle}, style);
}

// One that an answer names, or that is in question.
void FlightDrawing::add_obstacle(const Stretch& stretch, const ObstacleId& id, const Vec& centre) {
  const Point at{stretch.left + (dot(centre, axes_.along) - stretch.low) * result_.scale,
                 panel_.middle() - dot(centre, axes_.across) * result_.scale};
  if (std::fabs(at.x) > 1e4 || std::fabs(at.y) > 1e4) return;
  const Ink ink = *ink_of(case_, id);
  const Atom& atom = case_.atom_of(id);
  open_hint(svg_, hint_of(case_, id));
  add_section(atom, at, dot(centre, axes_.depth), paint(ink, ink, 1.5) + " fill-opacity=\"0.3\"");
  if (case_.scene.dimension == 3)
    add_shadow(atom, at, outline(ink, 0.8) + " fill=\"none\" stroke-dasharray=\"2 3\"");
  svg_.close();
}

void FlightDrawing::add_line(const Stretch& stretch, const Answer& answer, const std::string& style,
                             Ink ink) {
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

void FlightDrawing::add_stretch(const Stretch& stretch) {
  const Panel window{stretch.left, panel_.top, (stretch.high - stretch.low) * result_.scale, panel_.height};
  open_clip(svg_, window);
  add_neighbours(stretch, window);
  for (const ObstacleId& id : marked_obstacles(case_))
    add_obstacle(stretch, id, case_.surroundings.centre(case_.query, stretch.anchor, id));
  add_line(stretch, case_.exact, outline(kExactInk, 2.6), kExactInk);
  if (case_.given) add_line(stretch, *case_.given, outline(kGivenInk, 1.8) + kGivenDashes, kGivenInk);
  close_clip(svg_);
}

// A zigzag between stretches, with the number of cells left out.
void FlightDrawing::add_breaks() {
  for (std::size_t i = 1; i < stretches_.size(); ++i) {
    const Stretch &before = stretches_[i - 1], &after = stretches_[i];
    const double cells = (way(before.anchor, after.anchor) + after.low - before.high) / cell_;
    const double x = after.left - kBreak / 2, y = panel_.middle();
    open_hint(svg_, fmt::format("{:.6g} cells of the flight are left out", cells));
    for (const double side : {-6.0, 6.0}) {
      std::vector<Point> zigzag;
      for (int k = -9; k <= 9; ++k) zigzag.push_back({x + side + (k % 2 == 0 ? -3 : 3), y + 10.0 * k});
      svg_.polyline(zigzag, outline(kFaintInk, 1));
    }
    svg_.close();
    svg_.text({x, panel_.bottom() - 2}, fmt::format("{:.3g} cells", cells),
              paint(kInk) + " text-anchor=\"middle\" font-size=\"10\"");
  }
}

void FlightDrawing::add_ends() {
  const auto add = [&](const Answer& answer, Ink ink, bool cross) {
    const auto end = case_.end_of(answer);
    const auto at = end ? on_line(*end) : std::nullopt;
    if (!at) return;
    open_hint(svg_, fmt::format("{}: {:.9g} of length from the start", cross ? "given" : "exact",
                                way(PlaceOnLine::start(), *end)));
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

FlightPanel FlightDrawing::draw() {
  lay_out();
  for (const Stretch& stretch : stretches_) add_stretch(stretch);
  add_breaks();
  add_ends();
  if (case_.issue != Issue::none) result_.at = on_line(place_in_question(case_));
  if (enlarged_) result_.notes.push_back("Obstacles are smaller than they are drawn.");
  if (incomplete_) result_.notes.push_back("There are more obstacles than are drawn.");
  if (case_.scene.dimension == 3)
    result_.notes.push_back(
        "Above: the plane of the flight and the obstacle's centre; dotted: what is in front or behind.");
  return std::move(result_);
}

}  // namespace

oracle::PlaceOnLine place_in_question(const FindingCase& finding) {
  return finding.issue == Issue::start ? PlaceOnLine::start() : PlaceOnLine::at(finding.obstacle);
}

FlightPanel draw_flight(Svg& svg, const FindingCase& finding, const Panel& panel) {
  return FlightDrawing(svg, finding, panel).draw();
}

}  // namespace lorentz::pictures
