// Pictures of 3D scenes: orthographic projection along a direction in which nothing lines up, with the
// farthest obstacle drawn first. Parts of edges and flights that an obstacle hides are drawn faint.
#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "report/pictures/drawing_parts.hpp"

namespace lorentz::pictures {
namespace {

constexpr double kTallest3D = 900;

// ---- The cube that shows the structure of a centred cubic lattice, which its primitive cell does not

constexpr double kRounding = 1e-9;

// Lattice vectors of the wanted length, one of each pair +-u, from short combinations of a short basis.
std::vector<Vec> vectors_of_length(const std::array<Vec, 3>& u, double wanted) {
  std::vector<Vec> found;
  for (int i = -2; i <= 2; ++i)
    for (int k = -2; k <= 2; ++k)
      for (int m = -2; m <= 2; ++m) {
        if (i < 0 || (i == 0 && (k < 0 || (k == 0 && m <= 0)))) continue;
        const Vec v = sum(sum(scaled(u[0], i), scaled(u[1], k)), scaled(u[2], m));
        if (std::fabs(length(v) - wanted) < kRounding * wanted) found.push_back(v);
      }
  return found;
}

bool are_square(const Vec& a, const Vec& b) {
  return std::fabs(dot(a, b)) < kRounding * dot(a, a);
}

// Sorts the vectors by their nearest axes, all pointing in the positive direction: the usual way to draw a
// cube.
std::array<Vec, 3> upright(std::array<Vec, 3> cube) {
  for (int i = 0; i < 3; ++i) {
    for (int k = i + 1; k < 3; ++k)
      if (std::fabs(cube[k][i]) > std::fabs(cube[i][i])) std::swap(cube[i], cube[k]);
    if (cube[i][i] < 0) cube[i] = scaled(cube[i], -1);
  }
  return cube;
}

}  // namespace

ShownCell shown_cell(const Lattice& lattice) {
  const std::array<Vec, 3> short_vectors = with_short_vectors(lattice, 3).vectors;
  const double volume = cell_volume(lattice, 3);
  for (const int cells : {2, 4}) {
    const std::vector<Vec> edges = vectors_of_length(short_vectors, std::cbrt(cells * volume));
    for (std::size_t i = 0; i < edges.size(); ++i)
      for (std::size_t k = i + 1; k < edges.size(); ++k)
        for (std::size_t m = k + 1; m < edges.size(); ++m)
          if (are_square(edges[i], edges[k]) && are_square(edges[k], edges[m]) &&
              are_square(edges[m], edges[i]))
            return {upright({edges[i], edges[k], edges[m]}), cells};
  }
  return {lattice.vectors, 1};
}

// ---- The picture

namespace {

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

class Picture3D {
 public:
  Picture3D(const Scene& scene, const DrawOptions& options, const std::vector<DrawnFlight>& flights)
      : scene_(scene),
        options_(options),
        cell_(scene.lattices[0].rank < 3 ? ShownCell{scene.lattices[0].vectors}
                                         : shown_cell(scene.lattices[0])) {
    lines_ = lines_of(scene, flights, drawing_.remarks);
    corner_ = cell_at(scene, cell_.vectors, lines_.empty() ? Vec{} : lines_[0].from, 2);
    choose_obstacles();
    explain();
    fit();
  }

  Drawing draw() {
    svg_.raw(shades());
    for (const SeenObstacle& seen : seen_) add_obstacle(seen);
    add_cell();
    for (const DrawnLine& line : lines_) add_flight(line);
    drawing_.svg = finished(svg_, scene_, options_, legend_, window_.top + window_.height());
    return std::move(drawing_);
  }

 private:
  struct Pen {
    std::string colour;
    double width;
    bool arrow = false;
  };

  // Chooses the obstacles with centres in, or on the boundary of, a block of 2 x 2 x 2 primitive cells or a
  // cube, and those that are hit.
  void choose_obstacles() {
    const auto& u = cell_.vectors;
    double expected = 0;
    for (const Lattice& lattice : scene_.lattices)
      expected += static_cast<double>(lattice.atoms.size()) * 27 * cell_volume(scene_.lattices[0], 3) /
                  cell_volume(lattice, 3);
    const double cells = cells_ = expected > 300 || cell_.primitive_cells > 1 ? 1 : 2;
    Extent box{corner_, corner_};
    for (int n = 0; n < 8; ++n) box.include(vertex(cells_, n));
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
  void explain() {
    for (const SeenObstacle& seen : seen_) legend_.atoms.insert({seen.placed.lattice, seen.placed.atom});
    if (scene_.lattices[0].rank == 3)
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
    legend_.notes = drawing_.remarks;
    if (!lines_.empty())
      legend_.notes.push_back("Beyond the block of cells, only obstacles that are hit are drawn.");
  }

  void fit() {
    const bool has_cell = scene_.lattices[0].rank == 3;
    Extent& box = window_.box;
    box.low = box.high = has_cell || seen_.empty() ? eye_(corner_) : seen_[0].view;
    for (const SeenObstacle& seen : seen_) {
      const auto [rx, ry, angle] = seen.shape;
      const Vec half{std::hypot(rx * std::cos(angle), ry * std::sin(angle)),
                     std::hypot(rx * std::sin(angle), ry * std::cos(angle)), 0};
      box.include(sum(seen.view, half));
      box.include(plus(seen.view, -1, half));
    }
    for (const DrawnLine& line : lines_) {
      box.include(eye_(line.from));
      box.include(eye_(line.to));
    }
    for (int n = 0; n < (has_cell ? 8 : 0); ++n) box.include(eye_(vertex(1, n)));
    const double margin = 0.02 * box.width();
    for (int k = 0; k < 2; ++k) {
      box.low[k] -= margin;
      box.high[k] += margin;
    }
    const Page page(scene_, options_, legend_, kTallest3D);
    window_.top = page.top;
    window_.scale = std::min(page.width / box.width(), page.height / box.height());
    const double spare = page.width / window_.scale - box.width();  // a tall picture is centred
    box.low[0] -= spare / 2;
    box.high[0] += spare / 2;
  }

  // True if an obstacle lies between the point and the eye, or contains the point.
  bool is_hidden(const Vec& point) const {
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
  void add_line(const Vec& from, const Vec& to, const Pen& pen) {
    const Vec way = plus(to, -1, from);
    const double length = window_.scale * std::hypot(dot(way, eye_.right), dot(way, eye_.up));
    const int pieces = std::clamp(static_cast<int>(length / 3), 8, lines_.size() > 50 ? 100 : 600);
    const auto point = [&](int i) { return plus(from, static_cast<double>(i) / pieces, way); };
    for (int i = 0; i < pieces;) {
      const auto hidden_in = [&](int k) { return is_hidden(plus(from, (k + 0.5) / pieces, way)); };
      const bool hidden = hidden_in(i);
      int end = i + 1;
      while (end < pieces && hidden_in(end) == hidden) ++end;
      svg_.polyline({at(point(i)), at(point(end))},
                    fmt::format("stroke=\"{}\" stroke-width=\"{:.4g}\"{}", pen.colour, pen.width,
                                hidden ? " stroke-opacity=\"0.45\" stroke-dasharray=\"2 3\"" : ""));
      i = end;
    }
    if (pen.arrow) svg_.arrow(at(point(pieces - 1)), at(to), 11, pen.colour, pen.width);
  }

  void add_obstacle(const SeenObstacle& seen) {
    constexpr double kSmallest = 1.4;
    const std::size_t index = colour_index(scene_, seen.placed);
    svg_.ellipse(window_(seen.view), to_scale(seen.shape, window_.scale, kSmallest),
                 fmt::format("fill=\"url(#shade{})\" stroke=\"{}\" stroke-width=\"{}\"", index % 10,
                             seen.hit ? kFlightColour : colour(index).dark, seen.hit ? 2.2 : 0.7));
  }

  void add_cell() {
    if (scene_.lattices[0].rank < 3) return;
    const auto& u = cell_.vectors;
    for (int i = 0; i < 3; ++i)
      for (int n = 0; n < 4; ++n) {
        Vec from = corner_;
        if (n & 1) from = sum(from, u[(i + 1) % 3]);
        if (n & 2) from = sum(from, u[(i + 2) % 3]);
        add_line(from, sum(from, u[i]), {"#111111", 1.6});
      }
  }

  void add_flight(const DrawnLine& line) {
    add_line(line.from, line.to, {kFlightColour, 2, !line.ends});
    svg_.ellipse(at(line.from), {3.2, 3.2, 0},
                 fmt::format("fill=\"white\" stroke=\"{}\" stroke-width=\"1.4\"", kFlightColour));
    if (line.ends)
      svg_.ellipse(
          at(line.to), {2.8, 2.8, 0},
          fmt::format("fill=\"{}\" fill-opacity=\"{}\"", kFlightColour, is_hidden(line.to) ? 0.3 : 1.0));
  }

  // A corner, 0 to 7, of the block with this number of cells along each edge.
  Vec vertex(double cells, int number) const {
    Vec p = corner_;
    for (int i = 0; i < 3; ++i)
      if (number >> i & 1) p = plus(p, cells, cell_.vectors[i]);
    return p;
  }
  Point at(const Vec& place) const { return window_(eye_(place)); }

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
  PaperWindow window_;  // on the picture, seen from the eye
};

}  // namespace

Drawing draw_scene_3d(const Scene& scene, const DrawOptions& options,
                      const std::vector<DrawnFlight>& flights) {
  return Picture3D(scene, options, flights).draw();
}

}  // namespace lorentz::pictures
