// Pictures of 3D scenes: orthographic projection along a direction in which nothing lines up, with the
// farthest obstacle drawn first. Parts of edges and flights that an obstacle hides are drawn faint.
#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "report/pictures/drawing_parts.hpp"

namespace lorentz::pictures {
namespace {

constexpr double kTallest3D = 900;

// Directions to the right, upwards and towards the eye. The eye is a little to the right of the y axis, and
// above.
struct Eye {
  Vec right, up, towards;

  Eye() {
    constexpr double kAzimuth = 0.42, kElevation = 0.31;
    const double ca = std::cos(kAzimuth), sa = std::sin(kAzimuth), ce = std::cos(kElevation),
                 se = std::sin(kElevation);
    right = {ca, sa, 0};
    towards = {sa * ce, -ca * ce, se};
    up = {-sa * se, ca * se, ce};
  }
  Vec operator()(const Vec& p) const { return {dot(right, p), dot(up, p), dot(towards, p)}; }
};

// An obstacle as it is seen.
struct SeenObstacle {
  Placed placed;
  bool hit;
  Vec view;                    // its centre
  EllipseShape shape;          // its outline, in the scene's unit
  std::array<Vec, 3> inverse;  // of its matrix, as rows
};

class Picture3D {
 public:
  Picture3D(const Scene& scene, const DrawOptions& options, const std::vector<DrawnFlight>& flights)
      : scene_(scene),
        options_(options),
        cell_(scene.lattices[0].missing > 0
                  ? ShownCell{scene.lattices[0].vectors}
                  : shown_cell(scene.lattices[0], short_vectors(scene.lattices[0], 3))) {
    lines_ = lines_of(scene, flights, drawing_.remarks);
    corner_ = cell_at(scene, cell_.vectors, lines_.empty() ? Vec{} : lines_[0].from, 2);
    choose_obstacles();
    explain();
    fit();
  }

  Drawing draw();

 private:
  void choose_obstacles();
  void explain();
  void fit();
  void add_contents(const std::vector<SeenObstacle>& obstacles, std::vector<Facet> facets);
  void add_cylinders();
  void add_cell();
  void add_flight(const DrawnLine& line);
  DrawnBlock block(double cells) const {
    const auto& u = cell_.vectors;
    return {corner_, {scaled(u[0], cells), scaled(u[1], cells), scaled(u[2], cells)}};
  }
  DrawnBlock block() const { return block(cells_); }
  void add_obstacle(const SeenObstacle& seen);
  struct Pen {
    std::string colour;
    double width;
    bool arrow = false;
    std::string seen = "", hidden = " stroke-opacity=\"0.45\" stroke-dasharray=\"2 3\"";
  };
  void add_line(const Vec& from, const Vec& to, const Pen& pen);
  bool is_hidden(const Vec& point) const;
  Point at(const Vec& view) const {
    return {kMargin + scale_ * (view[0] - box_.low[0]), top_ + scale_ * (box_.high[1] - view[1])};
  }

  const Scene& scene_;
  const DrawOptions& options_;
  ShownCell cell_;
  double cells_ = 1;  ///< number of these along each edge of the block
  Legend legend_;
  Eye eye_;
  Drawing drawing_;
  Svg svg_;
  std::vector<DrawnLine> lines_;
  Vec corner_{};
  std::vector<SeenObstacle> seen_;
  Extent box_;  // of the picture, seen from the eye
  double scale_ = 1, top_ = 0;
};

// Chooses the obstacles with centres in, or on the boundary of, a block of 2 x 2 x 2 primitive cells or a
// cube, and those that are hit.
void Picture3D::choose_obstacles() {
  const auto& u = cell_.vectors;
  double expected = 0;
  for (const Lattice& lattice : scene_.lattices)
    expected += static_cast<double>(lattice.atoms.size()) * 27 * cell_volume(scene_.lattices[0], 3) /
                cell_volume(lattice, 3);
  const double cells = cells_ = expected > 300 || cell_.primitive_cells > 1 ? 1 : 2;
  Extent box{corner_, corner_};
  for (int n = 0; n < 8; ++n) box.include(block().vertex(n));
  bool cut = false;
  std::vector<Placed> obstacles = obstacles_in(scene_, box, cut);
  const auto rows = dual_of(u, 3);
  std::erase_if(obstacles, [&](const Placed& obstacle) {
    constexpr double kSlack = 1e-6;
    for (const Vec& row : rows) {
      const double n = dot(row, plus(obstacle.centre, -1, corner_));
      if (n < -kSlack || n > cells + kSlack) return true;
    }
    return false;
  });
  thin_out(obstacles, plus(corner_, cells / 2, sum(sum(u[0], u[1]), u[2])), drawing_.remarks);
  if (cut) drawing_.remarks.push_back("some lattices are too fine for this picture and left out");
  const std::vector<Placed> hits = hits_of(scene_, lines_);
  const auto is_hit = [&](const Placed& a) {
    return std::any_of(hits.begin(), hits.end(), [&](const Placed& b) {
      const Vec arm = plus(a.centre, -1, b.centre);
      return a.lattice == b.lattice && a.atom == b.atom &&
             dot(arm, arm) < 1e-12 * cell_size(scene_) * cell_size(scene_);
    });
  };
  std::erase_if(obstacles, is_hit);
  const auto see = [&](const Placed& placed, bool is_hit) {
    const Atom& atom = scene_.lattices[placed.lattice].atoms[placed.atom];
    seen_.push_back({placed, is_hit, eye_(placed.centre), shadow_of(atom, 3, eye_.right, eye_.up),
                     dual_of(semiaxes_of(atom, 3), 3)});
  };
  for (const Placed& placed : obstacles) see(placed, false);
  for (const Placed& placed : hits) see(placed, true);
  std::sort(seen_.begin(), seen_.end(),
            [](const SeenObstacle& a, const SeenObstacle& b) { return a.view[2] < b.view[2]; });
}

// Fills in what the legend must explain.
void Picture3D::explain() {
  for (const SeenObstacle& seen : seen_) legend_.atoms.insert({seen.placed.lattice, seen.placed.atom});
  if (scene_.lattices[0].missing == 0)
    legend_.cell = cell_.primitive_cells > 1
                       ? fmt::format("the cube of {} primitive cells", cell_.primitive_cells)
                   : scene_.lattices.size() > 1 ? "a cell of lattice 0"
                                                : "a primitive cell";
  for (const DrawnLine& line : lines_) {
    const Outcome outcome = line.flight->answer.outcome;
    legend_.never |= outcome == Outcome::never;
    legend_.inside |= outcome == Outcome::inside;
    (line.ends ? legend_.hits : legend_.goes_on) |= outcome == Outcome::hit;
  }
  for (std::size_t i = 0; i < options_.ways.size(); ++i) {
    const FreeWay& way = options_.ways[i];
    const bool there = way.kind == FreeWay::Kind::cylinder ? axis_of(scene_, way, block()).has_value()
                                                           : !faces_of(scene_, way, i, block()).empty();
    if (there) legend_.ways.push_back(i);
  }
  legend_.notes = drawing_.remarks;
  if (!lines_.empty())
    legend_.notes.push_back("Beyond the block of cells, only obstacles that are hit are drawn.");
}

// Extended beyond the block at both ends, to show that it goes through.
std::array<Vec, 2> longer(const std::array<Vec, 2>& axis) {
  const Vec more = scaled(plus(axis[1], -1, axis[0]), 0.15);
  return {plus(axis[0], -1, more), sum(axis[1], more)};
}

void Picture3D::fit() {
  const bool has_cell = scene_.lattices[0].missing == 0;
  box_.low = box_.high = has_cell || seen_.empty() ? eye_(corner_) : seen_[0].view;
  for (const SeenObstacle& seen : seen_) {
    const auto [rx, ry, angle] = seen.shape;
    const double half[] = {std::hypot(rx * std::cos(angle), ry * std::sin(angle)),
                           std::hypot(rx * std::sin(angle), ry * std::cos(angle))};
    for (int k = 0; k < 2; ++k) {
      box_.low[k] = std::min(box_.low[k], seen.view[k] - half[k]);
      box_.high[k] = std::max(box_.high[k], seen.view[k] + half[k]);
    }
  }
  for (const DrawnLine& line : lines_) {
    box_.include(eye_(line.from));
    box_.include(eye_(line.to));
  }
  const double reach = options_.ways.empty() ? 1 : cells_;
  for (int n = 0; n < (has_cell ? 8 : 0); ++n) box_.include(eye_(block(reach).vertex(n)));
  for (const std::size_t number : legend_.ways)
    if (options_.ways[number].kind == FreeWay::Kind::cylinder) {
      for (const Vec& end : longer(*axis_of(scene_, options_.ways[number], block())))
        box_.include(eye_(end), options_.ways[number].width / 2);
    }
  const double margin = 0.02 * box_.width();
  for (int k = 0; k < 2; ++k) {
    box_.low[k] -= margin;
    box_.high[k] += margin;
  }
  const Page page(scene_, options_, legend_, kTallest3D);
  top_ = page.top;
  scale_ = std::min(page.width / box_.width(), page.height / box_.height());
  const double spare = page.width / scale_ - box_.width();  // a tall picture is centred
  box_.low[0] -= spare / 2;
  box_.high[0] += spare / 2;
}

// True if an obstacle lies between the point and the eye, or contains the point.
bool Picture3D::is_hidden(const Vec& point) const {
  constexpr double kSlack = 1e-6;
  const Vec view = eye_(point);
  for (const SeenObstacle& seen : seen_) {
    if (std::hypot(seen.view[0] - view[0], seen.view[1] - view[1]) > seen.shape.rx) continue;
    const Vec w = coordinates(seen.inverse, plus(point, -1, seen.placed.centre)),
              d = coordinates(seen.inverse, eye_.towards);
    const double a = dot(d, d), b = dot(w, d), c = dot(w, w) - 1;
    if (c < -kSlack || (b < 0 && b * b - a * c > kSlack * a)) return true;
  }
  return false;
}

// Adds a line in pieces: full where it is visible, faint where it is hidden.
void Picture3D::add_line(const Vec& from, const Vec& to, const Pen& pen) {
  const Vec way = plus(to, -1, from);
  const double length = scale_ * std::hypot(dot(way, eye_.right), dot(way, eye_.up));
  const int pieces = std::clamp(static_cast<int>(length / 3), 8, lines_.size() > 50 ? 100 : 600);
  const auto point = [&](int i) { return plus(from, static_cast<double>(i) / pieces, way); };
  for (int i = 0; i < pieces;) {
    const auto hidden_in = [&](int k) { return is_hidden(plus(from, (k + 0.5) / pieces, way)); };
    const bool hidden = hidden_in(i);
    int end = i + 1;
    while (end < pieces && hidden_in(end) == hidden) ++end;
    svg_.polyline({at(eye_(point(i))), at(eye_(point(end)))},
                  fmt::format("stroke=\"{}\" stroke-width=\"{:.4g}\"{}", pen.colour, pen.width,
                              hidden ? pen.hidden : pen.seen));
    i = end;
  }
  if (pen.arrow) svg_.arrow(at(eye_(point(pieces - 1))), at(eye_(to)), 11, pen.colour, pen.width);
}

void Picture3D::add_obstacle(const SeenObstacle& seen) {
  constexpr double kSmallest = 1.4;
  const std::size_t index = colour_index(scene_, seen.placed);
  svg_.ellipse(at(seen.view), to_scale(seen.shape, scale_, kSmallest),
               fmt::format("fill=\"url(#shade{})\" stroke=\"{}\" stroke-width=\"{}\"", index % 10,
                           seen.hit ? kFlightColour : colour(index).dark, seen.hit ? 2.2 : 0.7));
}

std::string shades() {
  std::string shades = "<defs>\n";
  for (std::size_t i = 0; i < 10; ++i)
    shades += fmt::format(
        "<radialGradient id=\"shade{}\" cx=\"0.5\" cy=\"0.5\" r=\"0.5\" fx=\"0.35\" fy=\"0.3\"><stop "
        "offset=\"0\" "
        "stop-color=\"{}\"/><stop offset=\"0.6\" stop-color=\"{}\"/><stop offset=\"1\" "
        "stop-color=\"{}\"/></radialGradient>\n",
        i, colour(i).light, colour(i).fill, colour(i).dark);
  return shades + "</defs>\n";
}

// No obstacle crosses a face of a free layer. So the obstacles beyond it come first, then the face, then the
// obstacles before it. It cuts the other faces in two.
void Picture3D::add_contents(const std::vector<SeenObstacle>& obstacles, std::vector<Facet> facets) {
  if (facets.empty()) {
    for (const SeenObstacle& seen : obstacles) add_obstacle(seen);
    return;
  }
  const Facet face = facets.back();
  facets.pop_back();
  const int nearer = dot(face.normal, eye_.towards) > 0 ? 1 : -1;
  for (const int side : {-nearer, nearer}) {
    std::vector<SeenObstacle> some;
    for (const SeenObstacle& seen : obstacles)
      if ((side * (dot(face.normal, seen.placed.centre) - face.level) >= 0)) some.push_back(seen);
    std::vector<Facet> parts;
    for (const Facet& other : facets) {
      Facet part = part_beside(other, face.normal, face.level, side);
      if (part.corners.size() > 2) parts.push_back(std::move(part));
    }
    add_contents(some, std::move(parts));
    if (side == nearer) break;
    std::vector<Point> outline;
    for (const Vec& corner : face.corners) outline.push_back(at(eye_(corner)));
    svg_.polygon(outline,
                 fmt::format("fill=\"{0}\" fill-opacity=\"0.28\" stroke=\"{0}\" stroke-width=\"0.8\"",
                             way_colour(face.way)));
  }
}

void Picture3D::add_cylinders() {
  for (const std::size_t number : legend_.ways) {
    const FreeWay& way = options_.ways[number];
    if (way.kind != FreeWay::Kind::cylinder) continue;
    const auto [from, to] = longer(*axis_of(scene_, way, block()));
    add_line(from, to,
             {way_colour(number), std::max(1.5, scale_ * way.width), false, " stroke-opacity=\"0.6\"",
              " stroke-opacity=\"0.15\""});
  }
}

void Picture3D::add_cell() {
  if (scene_.lattices[0].missing > 0) return;
  const auto& u = cell_.vectors;
  for (int i = 0; i < 3; ++i)
    for (int n = 0; n < 4; ++n) {
      Vec from = corner_;
      if (n & 1) from = sum(from, u[(i + 1) % 3]);
      if (n & 2) from = sum(from, u[(i + 2) % 3]);
      add_line(from, sum(from, u[i]), {"#111111", 1.6});
    }
}

void Picture3D::add_flight(const DrawnLine& line) {
  add_line(line.from, line.to, {kFlightColour, 2, !line.ends});
  svg_.ellipse(at(eye_(line.from)), {3.2, 3.2, 0},
               fmt::format("fill=\"white\" stroke=\"{}\" stroke-width=\"1.4\"", kFlightColour));
  if (line.ends)
    svg_.ellipse(
        at(eye_(line.to)), {2.8, 2.8, 0},
        fmt::format("fill=\"{}\" fill-opacity=\"{}\"", kFlightColour, is_hidden(line.to) ? 0.3 : 1.0));
}

Drawing Picture3D::draw() {
  svg_.raw(shades());
  std::vector<Facet> facets;
  for (const std::size_t number : legend_.ways)
    if (options_.ways[number].kind == FreeWay::Kind::layer)
      for (Facet& face : faces_of(scene_, options_.ways[number], number, block()))
        facets.push_back(std::move(face));
  add_contents(seen_, std::move(facets));
  add_cylinders();
  add_cell();
  for (const DrawnLine& line : lines_) add_flight(line);
  drawing_.svg = finished(svg_, scene_, options_, legend_, top_ + scale_ * box_.height());
  return std::move(drawing_);
}

}  // namespace

Drawing draw_scene_3d(const Scene& scene, const DrawOptions& options,
                      const std::vector<DrawnFlight>& flights) {
  return Picture3D(scene, options, flights).draw();
}

}  // namespace lorentz::pictures
