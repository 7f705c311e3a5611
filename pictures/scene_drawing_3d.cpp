// Pictures of 3D scenes: orthographic projection along a direction in which nothing lines up, the farthest
// obstacle first. Of edges and flights, what an obstacle hides is drawn faint.
#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "pictures/drawing_parts.hpp"

namespace lorentz::pictures {
namespace {

constexpr double kTallest = 900;

// Directions to the right, upwards and towards the eye: seen from a little to the right of the y axis and
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

Vec plus(const Vec& a, const Vec& b, double share = 1) {
  return {a[0] + share * b[0], a[1] + share * b[1], a[2] + share * b[2]};
}

// An obstacle seen.
struct Seen {
  Placed placed;
  bool hit;
  Vec view;            // its centre
  EllipseShape shape;  // its outline, in the scene's unit
};

class Picture {
 public:
  Picture(const Scene& scene, const std::vector<Flight>& flights) : scene_(scene) {
    lines_ = lines_of(scene, flights, drawing_.remarks);
    if (!lines_.empty()) corner_ = cell_at(scene, lines_[0].from);
    choose_obstacles();
    fit();
  }

  Drawing draw(const std::string& title);

 private:
  void choose_obstacles();
  void fit();
  void add_obstacle(const Seen& seen);
  void add_line(const Vec& from, const Vec& to, const std::string& colour, double width, bool arrow);
  bool is_hidden(const Vec& point) const;
  Point at(const Vec& view) const {
    return {kMargin + scale_ * (view[0] - box_.low[0]), kTitleHeight + scale_ * (box_.high[1] - view[1])};
  }

  const Scene& scene_;
  Eye eye_;
  Drawing drawing_;
  Svg svg_;
  std::vector<Line> lines_;
  Vec corner_{};
  std::vector<Seen> seen_;
  std::vector<std::vector<std::array<Vec, 3>>> inverses_;  // of each atom's matrix, as rows
  Box box_;                                                // of the picture, seen from the eye
  double scale_ = 1;
};

// The obstacles with centres in a block of 2 x 2 x 2 cells or on its boundary, and those that are hit.
void Picture::choose_obstacles() {
  const auto& u = scene_.lattices[0].vectors;
  double expected = 0;
  for (const Lattice& lattice : scene_.lattices)
    expected += static_cast<double>(lattice.atoms.size()) * 27 * cell_volume(scene_.lattices[0], 3) /
                cell_volume(lattice, 3);
  const double cells = expected > 300 ? 1 : 2;
  Box box{corner_, corner_};
  for (int n = 0; n < 8; ++n) {
    Vec p = corner_;
    for (int i = 0; i < 3; ++i)
      if (n >> i & 1) p = plus(p, u[i], cells);
    box.include(p);
  }
  bool cut = false;
  std::vector<Placed> obstacles = obstacles_in(scene_, box, cut);
  const auto rows = dual_of(u, 3);
  std::erase_if(obstacles, [&](const Placed& obstacle) {
    constexpr double kSlack = 1e-6;
    for (const Vec& row : rows) {
      const double n = dot(row, plus(obstacle.centre, corner_, -1));
      if (n < -kSlack || n > cells + kSlack) return true;
    }
    return false;
  });
  thin_out(obstacles, plus(corner_, plus(plus(u[0], u[1]), u[2]), cells / 2), drawing_.remarks);
  if (cut) drawing_.remarks.push_back("some lattices are too fine for this picture and left out");
  const std::vector<Placed> hits = hits_of(scene_, lines_);
  const auto is_hit = [&](const Placed& a) {
    return std::any_of(hits.begin(), hits.end(), [&](const Placed& b) {
      const Vec arm = plus(a.centre, b.centre, -1);
      return a.lattice == b.lattice && a.atom == b.atom &&
             dot(arm, arm) < 1e-12 * cell_size(scene_) * cell_size(scene_);
    });
  };
  std::erase_if(obstacles, is_hit);
  const auto see = [&](const Placed& placed, bool is_hit) {
    const auto columns = semiaxes_of(scene_.lattices[placed.lattice].atoms[placed.atom], 3);
    Vec m1{}, m2{};
    for (int i = 0; i < 3; ++i) {
      m1[i] = dot(columns[i], eye_.right);
      m2[i] = dot(columns[i], eye_.up);
    }
    seen_.push_back({placed, is_hit, eye_(placed.centre), ellipse_of(m1, m2)});
  };
  for (const Placed& placed : obstacles) see(placed, false);
  for (const Placed& placed : hits) see(placed, true);
  std::sort(seen_.begin(), seen_.end(), [](const Seen& a, const Seen& b) { return a.view[2] < b.view[2]; });
  for (const Lattice& lattice : scene_.lattices) {
    inverses_.emplace_back();
    for (const Atom& atom : lattice.atoms) inverses_.back().push_back(dual_of(semiaxes_of(atom, 3), 3));
  }
}

void Picture::fit() {
  box_.low = box_.high = eye_(corner_);
  for (const Seen& seen : seen_) {
    const auto [rx, ry, angle] = seen.shape;
    const double half[] = {std::hypot(rx * std::cos(angle), ry * std::sin(angle)),
                           std::hypot(rx * std::sin(angle), ry * std::cos(angle))};
    for (int k = 0; k < 2; ++k) {
      box_.low[k] = std::min(box_.low[k], seen.view[k] - half[k]);
      box_.high[k] = std::max(box_.high[k], seen.view[k] + half[k]);
    }
  }
  for (const Line& line : lines_) {
    box_.include(eye_(line.from));
    box_.include(eye_(line.to));
  }
  const auto& u = scene_.lattices[0].vectors;
  for (int n = 0; n < 8; ++n) {
    Vec p = corner_;
    for (int i = 0; i < 3; ++i)
      if (n >> i & 1) p = plus(p, u[i]);
    box_.include(eye_(p));
  }
  const double margin = 0.02 * (box_.high[0] - box_.low[0]);
  for (int k = 0; k < 2; ++k) {
    box_.low[k] -= margin;
    box_.high[k] += margin;
  }
  const double wide = box_.high[0] - box_.low[0], tall = box_.high[1] - box_.low[1];
  scale_ = std::min((kPictureWidth - 2 * kMargin) / wide, kTallest / tall);
  const double spare = (kPictureWidth - 2 * kMargin) / scale_ - wide;  // a tall picture stands in the middle
  box_.low[0] -= spare / 2;
  box_.high[0] += spare / 2;
}

// True if an obstacle lies between the point and the eye, or holds the point.
bool Picture::is_hidden(const Vec& point) const {
  constexpr double kSlack = 1e-6;
  const Vec view = eye_(point);
  for (const Seen& seen : seen_) {
    if (std::hypot(seen.view[0] - view[0], seen.view[1] - view[1]) > seen.shape.rx) continue;
    const auto& rows = inverses_[seen.placed.lattice][seen.placed.atom];
    const Vec arm = plus(point, seen.placed.centre, -1);
    Vec w, d;
    for (int i = 0; i < 3; ++i) {
      w[i] = dot(rows[i], arm);
      d[i] = dot(rows[i], eye_.towards);
    }
    const double a = dot(d, d), b = dot(w, d), c = dot(w, w) - 1;
    if (c < -kSlack || (b < 0 && b * b - a * c > kSlack * a)) return true;
  }
  return false;
}

// In pieces: full where it can be seen, faint where not.
void Picture::add_line(const Vec& from, const Vec& to, const std::string& colour, double width, bool arrow) {
  const Vec way = plus(to, from, -1);
  const double length = scale_ * std::hypot(dot(way, eye_.right), dot(way, eye_.up));
  const int pieces = std::clamp(static_cast<int>(length / 3), 8, lines_.size() > 50 ? 100 : 600);
  const auto point = [&](int i) { return plus(from, way, static_cast<double>(i) / pieces); };
  for (int i = 0; i < pieces;) {
    const auto hidden_in = [&](int k) { return is_hidden(plus(from, way, (k + 0.5) / pieces)); };
    const bool hidden = hidden_in(i);
    int end = i + 1;
    while (end < pieces && hidden_in(end) == hidden) ++end;
    svg_.polyline({at(eye_(point(i))), at(eye_(point(end)))},
                  fmt::format("stroke=\"{}\" stroke-width=\"{}\"{}", colour, width,
                              hidden ? " stroke-opacity=\"0.45\" stroke-dasharray=\"2 3\"" : ""));
    i = end;
  }
  if (arrow) svg_.arrow(at(eye_(point(pieces - 1))), at(eye_(to)), 11, colour, width);
}

void Picture::add_obstacle(const Seen& seen) {
  constexpr double kSmallest = 1.4;
  const std::size_t index = colour_index(scene_, seen.placed);
  EllipseShape shape{scale_ * seen.shape.rx, scale_ * seen.shape.ry, -seen.shape.angle};
  if (shape.rx < kSmallest) shape = {kSmallest, kSmallest, 0};
  svg_.ellipse(at(seen.view), shape,
               fmt::format("fill=\"url(#shade{})\" stroke=\"{}\" stroke-width=\"{}\"", index % 10,
                           seen.hit ? kFlightColour : colour(index).dark, seen.hit ? 2.2 : 0.7));
}

Drawing Picture::draw(const std::string& title) {
  svg_.text({kMargin, 25}, title, "font-size=\"16\" font-weight=\"bold\"");
  std::string shades = "<defs>\n";
  for (std::size_t i = 0; i < 10; ++i)
    shades += fmt::format(
        "<radialGradient id=\"shade{}\" cx=\"0.5\" cy=\"0.5\" r=\"0.5\" fx=\"0.35\" fy=\"0.3\"><stop "
        "offset=\"0\" "
        "stop-color=\"{}\"/><stop offset=\"0.6\" stop-color=\"{}\"/><stop offset=\"1\" "
        "stop-color=\"{}\"/></radialGradient>\n",
        i, colour(i).light, colour(i).fill, colour(i).dark);
  svg_.raw(shades + "</defs>\n");
  for (const Seen& seen : seen_) add_obstacle(seen);
  const auto& u = scene_.lattices[0].vectors;
  for (int i = 0; i < 3; ++i)
    for (int n = 0; n < 4; ++n) {
      Vec from = corner_;
      if (n & 1) from = plus(from, u[(i + 1) % 3]);
      if (n & 2) from = plus(from, u[(i + 2) % 3]);
      add_line(from, plus(from, u[i]), "#111111", 1.6, false);
    }
  for (const Line& line : lines_) {
    add_line(line.from, line.to, kFlightColour, 2, !line.ends);
    svg_.ellipse(at(eye_(line.from)), {3.2, 3.2, 0},
                 fmt::format("fill=\"white\" stroke=\"{}\" stroke-width=\"1.4\"", kFlightColour));
    if (line.ends)
      svg_.ellipse(
          at(eye_(line.to)), {2.8, 2.8, 0},
          fmt::format("fill=\"{}\" fill-opacity=\"{}\"", kFlightColour, is_hidden(line.to) ? 0.3 : 1.0));
  }
  std::vector<std::string> notes = drawing_.remarks;
  if (!lines_.empty())
    notes.push_back("Of the obstacles beyond the block of cells, only those that are hit are drawn.");
  const double height = scale_ * (box_.high[1] - box_.low[1]);
  const double bottom = add_legend(svg_, scene_, kTitleHeight + height + 14, !lines_.empty(), notes);
  drawing_.svg = svg_.document(kPictureWidth, bottom + 6, title);
  return std::move(drawing_);
}

}  // namespace

Drawing draw_scene_3d(const Scene& scene, const std::string& title, const std::vector<Flight>& flights) {
  return Picture(scene, flights).draw(title);
}

}  // namespace lorentz::pictures
