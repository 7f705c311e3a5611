// The inset magnifies the place of a decision until the decisive distance takes a large part of it. It uses
// the coordinates in which the obstacle in question is a ball of radius 1. There the flight is still a line,
// from left to right, and the plane of the inset contains it and the centre.
//
// No place is a difference of large numbers: the distance is known (FindingCase), and a surface is drawn from
// one of its points, as the curve |y0 + B w| = 1 with w the place relative to that point.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/pictures/finding_parts.hpp"

namespace lorentz::pictures {
namespace {

using oracle::PlaceOnLine;

constexpr double kShare = 0.36;   // part of the inset that the distance takes
constexpr double kNatural = 45;   // pixels per radius if there is no distance to show
constexpr double kBeyond = 4000;  // pixels: outside any inset

// The surface of an obstacle in the plane of the inset, seen from a point of it.
struct InsetSurface {
  Vec right{}, up{};  // images of the inset's axes in the coordinates in which the obstacle is the unit ball
  Vec y0{};           // the point in these coordinates, of length 1
};

// The curve around the point in pixels, x to the right and y up: |y0 + (x right + y up) / scale| = 1, with
// its tangent as parameter. If it is nearly straight, only the part within kBeyond.
std::vector<Point> curve_of(const InsetSurface& surface, double scale) {
  Point normal{dot(surface.right, surface.y0), dot(surface.up, surface.y0)};  // outwards
  const double size = std::hypot(normal.x, normal.y);
  if (!(size > 0)) return {};
  normal = {normal.x / size, normal.y / size};
  const Point tangent{-normal.y, normal.x};
  const auto image = [&](Point p) { return sum(scaled(surface.right, p.x), scaled(surface.up, p.y)); };
  const Vec n = image(normal), t = image(tangent);
  // At u tangent - h normal: h^2 a - 2 h b + c = 0, b = p u + q, c = r u^2; the near side is the smaller
  // root.
  const double a = dot(n, n) / scale, p = dot(t, n) / scale, q = dot(n, surface.y0), r = dot(t, t) / scale;
  // The roots coincide at (p^2 - a r) u^2 + 2 p q u + q^2 = 0, the end of the surface as seen along n.
  const double rest = std::sqrt(std::max(0.0, a * r)), ahead = q / (rest - p), behind = q / (rest + p);
  std::vector<Point> near, far;
  constexpr int kSteps = 100;
  for (int k = -kSteps; k <= kSteps; ++k) {
    const double share = std::sin(std::numbers::pi / 2 * k / kSteps);
    const double u = share * std::min(800.0, share < 0 ? behind : ahead);
    const double b = p * u + q, c = r * u * u, root = std::sqrt(std::max(0.0, b * b - a * c));
    const auto at = [&](double h) {
      h = std::min(h, kBeyond);
      return Point{u * tangent.x - h * normal.x, u * tangent.y - h * normal.y};
    };
    near.push_back(at(c / (b + root)));
    far.push_back(at(a > 0 ? (b + root) / a : kBeyond));
  }
  near.insert(near.end(), far.rbegin(), far.rend());
  return near;
}

class Inset {
 public:
  Inset(Svg& svg, const FindingCase& finding, const Panel& panel)
      : svg_(svg),
        case_(finding),
        panel_(panel),
        to_ball_(to_ball(finding.atom_of(finding.obstacle), finding.scene.dimension)) {
    set_axes();
    set_scale();
  }

  double draw() {
    open_clip(svg_, panel_);
    if (case_.issue == Issue::line)
      draw_line();
    else if (case_.issue == Issue::start)
      draw_start();
    else
      draw_entries();
    add_scale_bar();
    close_clip(svg_);
    frame(svg_, panel_, outline(kInk, 1.2));
    return scale_;
  }

 private:
  void set_axes() {
    const Vec centre = case_.surroundings.centre(case_.query, case_.place(), case_.obstacle);
    right_ = unit(coordinates(to_ball_, case_.along));
    if (dot(centre, case_.across) < 0) side_ = -1;
    const Vec c = coordinates(to_ball_, centre), across = coordinates(to_ball_, scaled(case_.across, side_));
    for (const Vec& other : {c, across}) {
      const Vec rest = sum(other, scaled(right_, -dot(other, right_)));
      up_ = unit(rest);
      if (length(rest) > 1e-9 * length(other)) return;
    }
  }

  // Sets the pixels per radius so that the distance is well visible; for a distance of several radii they are
  // fewer.
  void set_scale() {
    const double size = std::fabs(case_.distance);
    const bool across = case_.issue == Issue::line || case_.issue == Issue::start;
    const double room = kShare * (across ? panel_.height : panel_.width);
    scale_ = size > 0 && std::isfinite(size) ? std::min(room / size, 1e290) : kNatural;
    origin_ = {panel_.left + panel_.width / 2, panel_.middle()};
  }

  // True if the flight of this answer passes the line's nearest point to the obstacle, or ends there.
  bool reaches(const Answer& answer) const {
    if (answer.outcome == Outcome::never) return true;
    const auto end = case_.end_of(answer);
    return end && answer.outcome == Outcome::hit &&
           case_.surroundings.way(case_.query, PlaceOnLine::at(case_.obstacle), *end) >= 0;
  }

  void add_surface(const ObstacleId& id, const InsetSurface& surface, double x, double y) {
    std::vector<Point> points = curve_of(surface, scale_);
    if (points.empty()) return;
    for (Point& p : points) p = paper(p.x + x, p.y + y);
    const Ink ink = ink_of(case_, id).value_or(kInk);
    open_hint(svg_, hint_of(case_, id));
    svg_.polygon(points, paint(ink, ink, 1) + " fill-opacity=\"0.25\"");
    svg_.close();
  }

  // Adds a part of the flight, in pixels from the origin, cut at the inset's edges.
  void add_stroke(double from, double to, Ink ink, double width, const char* more) {
    from = std::max(from, -panel_.width);
    to = std::min(to, panel_.width);
    if (from < to) svg_.polyline({paper(from, 0), paper(to, 0)}, outline(ink, width) + more);
  }

  // Adds the measured distance: a line between two points, with its length in radii.
  void add_distance(Point from, Point to, Point label, const char* anchor) {
    svg_.polyline({from, to}, outline(kInk, 1.2));
    for (const Point& end : {from, to}) svg_.ellipse(end, {2.2, 2.2, 0}, paint(kInk));
    const std::string words = case_.distance == 0
                                  ? "at one point"
                                  : fmt::format("{:.4g} {}", std::fabs(case_.distance),
                                                std::fabs(case_.distance) == 1 ? "radius" : "radii");
    svg_.text(label, words,
              paint(kInk, kPaper, 3) +
                  " paint-order=\"stroke\" font-size=\"12\" font-weight=\"bold\" text-anchor=\"" + anchor +
                  '"');
  }

  // Draws the line, and the surface where it is nearest to the line: above the line if the obstacle is missed.
  void draw_line() {
    const double gap = case_.distance * scale_;
    origin_.y += side_ * gap / 2;
    add_surface(case_.obstacle, {right_, up_, scaled(up_, -1)}, 0, gap);
    const double half_chord = gap < 0 ? std::sqrt(-case_.distance * (2 + case_.distance)) * scale_ : 0;
    add_stroke(-kBeyond, kBeyond, kFaintInk, 1, " stroke-dasharray=\"1 3\"");
    for (const Answer* answer : {&case_.exact, case_.given}) {
      if (!answer || !reaches(*answer)) continue;
      const bool ends = answer->outcome == Outcome::hit && answer->obstacle == case_.obstacle;
      add_flight(-kBeyond, ends ? -half_chord : kBeyond, answer == case_.given);
    }
    if (gap < 0 && half_chord > panel_.width / 2)
      svg_.text({panel_.left + 8, paper(0, 0).y - 5},
                fmt::format("the line, {:.3g} radii after it enters", half_chord / scale_),
                paint(kInk) + " font-size=\"10\"");
    const double beside = gap == 0 ? side_ * 14 : 0;  // away from the line and the surface, which coincide
                                                      // there
    add_distance(paper(0, 0), paper(0, gap), {paper(8, 0).x, paper(0, gap / 2).y + 4 + beside}, "start");
  }

  // Draws x, and the surface where it is nearest to x.
  void draw_start() {
    const Vec centre =
        coordinates(to_ball_, case_.surroundings.centre(case_.query, PlaceOnLine::start(), case_.obstacle));
    const Vec to_centre = unit(centre);
    const double cosine = dot(to_centre, right_), sine = dot(to_centre, up_), gap = case_.distance * scale_;
    origin_ = {origin_.x - gap * cosine / 2, origin_.y + side_ * gap * sine / 2};
    add_surface(case_.obstacle, {right_, up_, scaled(to_centre, -1)}, gap * cosine, gap * sine);
    for (const Answer* answer : {&case_.exact, case_.given}) {
      if (!answer || (answer->outcome != Outcome::hit && answer->outcome != Outcome::never)) continue;
      add_flight(0, kBeyond, answer == case_.given);
    }
    const Point surface = paper(gap * cosine, gap * sine), x = paper(0, 0);
    add_distance(x, surface, {(x.x + surface.x) / 2 + 8, (x.y + surface.y) / 2 - 6}, "start");
    svg_.ellipse(x, {4, 4, 0}, paint(kPaper, kInk, 1.5), "the start");
  }

  // Draws the entry into the obstacle, and the entry into another one or the place at the given time.
  void draw_entries() {
    const double way = case_.distance * scale_;
    origin_.x -= way / 2;
    const auto y0_of = [&](const ObstacleId& id, const std::array<Vec, 3>& rows) {
      const Vec centre = case_.surroundings.centre(case_.query, PlaceOnLine::at(id), id);
      return unit(scaled(coordinates(rows, centre), -1));
    };
    add_surface(case_.obstacle, {right_, up_, y0_of(case_.obstacle, to_ball_)}, 0, 0);
    if (case_.second) {
      const auto rows = to_ball(case_.atom_of(*case_.second), case_.scene.dimension);
      const auto columns = semiaxes_of(case_.atom_of(case_.obstacle), case_.scene.dimension);
      const auto back = [&](const Vec& y) {
        return coordinates(
            rows, sum(sum(scaled(columns[0], y[0]), scaled(columns[1], y[1])), scaled(columns[2], y[2])));
      };
      add_surface(*case_.second, {back(right_), back(up_), y0_of(*case_.second, rows)}, way, 0);
    }
    add_stroke(-kBeyond, std::max(way, 0.0), kFaintInk, 1, " stroke-dasharray=\"1 3\"");
    add_flight(-kBeyond, 0, false);
    if (case_.given && case_.end_of(*case_.given)) add_flight(-kBeyond, way, true);
    const Point a = paper(0, 0), b = paper(way, 0);
    add_distance(a, b, {(a.x + b.x) / 2, a.y - 9}, "middle");
  }

  // The bar's length is 1, 2 or 5 times a power of ten.
  void add_scale_bar() {
    const double most = 90 / scale_, power = std::pow(10, std::floor(std::log10(most)));
    const double bar = (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1) * power;
    const double left = panel_.left + 10, y = panel_.bottom() - 10, right = left + bar * scale_;
    svg_.polyline({{left, y - 4}, {left, y}, {right, y}, {right, y - 4}}, outline(kInk, 1.5));
    svg_.text({left, y - 8}, fmt::format("{:g} {}", bar, bar == 1 ? "radius" : "radii"),
              paint(kInk, kPaper, 3) + " paint-order=\"stroke\" font-size=\"11\"");
  }

  void add_flight(double from, double to, bool is_given) {
    add_stroke(from, to, is_given ? kGivenInk : kExactInk, is_given ? 1.8 : 2.6,
               is_given ? kGivenDashes : "");
  }
  Point paper(double x, double y) const { return {on_paper(origin_.x + x), on_paper(origin_.y - side_ * y)}; }

  Svg& svg_;
  const FindingCase& case_;
  const Panel panel_;
  const std::array<Vec, 3> to_ball_;
  Vec right_{}, up_{};  // axes of the inset, of length 1, in the coordinates of the ball
  double side_ = 1;     // -1: the centre is on the lower side
  double scale_ = 1;    // pixels per radius
  Point origin_{};
};

}  // namespace

double draw_inset(Svg& svg, const FindingCase& finding, const Panel& panel) {
  return Inset(svg, finding, panel).draw();
}

}  // namespace lorentz::pictures
