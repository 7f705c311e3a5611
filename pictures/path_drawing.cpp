#include "pictures/path_drawing.hpp"

#include <algorithm>

#include <lorentz/geometry.hpp>
#include "pictures/drawing_parts.hpp"

namespace lorentz::pictures {
namespace {

constexpr double kLegendLine = 22;
constexpr const char *kPathColour = "#1f5fa8", *kOtherColour = kFlightColour;

// The plane on paper, y upwards.
struct PathFrame {
  Extent box;
  double scale = 1;

  PathFrame(const PathDrawing& drawing) {
    const double cell = cell_size(drawing.scene);
    box = {drawing.path[0], drawing.path[0]};
    for (const auto* path : {&drawing.path, &drawing.other})
      for (const Vec& place : *path) box.include(place, 0.6 * cell);
    scale = (drawing.width - 2 * kMargin) / std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]);
  }
  Point operator()(const Vec& p) const {
    return {kMargin + scale * (p[0] - box.low[0]), kMargin + scale * (box.high[1] - p[1])};
  }
  double width() const { return 2 * kMargin + scale * (box.high[0] - box.low[0]); }
  double height() const { return 2 * kMargin + scale * (box.high[1] - box.low[1]); }
};

std::vector<Point> on_paper(const PathFrame& frame, const std::vector<Vec>& path, std::size_t from = 0) {
  std::vector<Point> points;
  for (std::size_t i = from; i < path.size(); ++i) points.push_back(frame(path[i]));
  return points;
}

EllipseShape shape_of(const Atom& atom, double scale) {
  if (atom.is_ball()) return {scale * atom.radius, scale * atom.radius, 0};
  const Vec &a = atom.semiaxes[0], &b = atom.semiaxes[1];
  return ellipse_of({scale * a[0], scale * b[0], 0}, {-scale * a[1], -scale * b[1], 0});
}

// Adds the obstacles; those at the edge are cut there. False if there are too many.
bool add_passed_obstacles(Svg& svg, const PathDrawing& drawing, const PathFrame& frame) {
  bool cut = false;
  const std::vector<Placed> obstacles = obstacles_in(drawing.scene, frame.box, cut);
  if (cut || obstacles.size() > kMostDrawn) return false;
  svg.raw(fmt::format("<clipPath id=\"window\"><rect width=\"{:.2f}\" height=\"{:.2f}\"/></clipPath>\n",
                      frame.width(), frame.height()));
  svg.open("clip-path=\"url(#window)\"");
  for (const Placed& obstacle : obstacles) {
    const Atom& atom = drawing.scene.lattices[obstacle.lattice].atoms[obstacle.atom];
    const Colour& its = colour(colour_index(drawing.scene, obstacle));
    svg.ellipse(frame(obstacle.centre), shape_of(atom, frame.scale),
                fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"0.7\"", its.light, its.dark),
                name_of(drawing.scene, obstacle));
  }
  svg.close();
  return true;
}

void add_path(Svg& svg, const std::vector<Point>& points, const char* colour_of_it, const char* more) {
  svg.polyline(points, fmt::format("stroke=\"{}\" stroke-width=\"1.8\" "
                                   "stroke-linejoin=\"round\"{}",
                                   colour_of_it, more));
  svg.ellipse(points.back(), {4, 4, 0}, fmt::format("fill=\"{}\"", colour_of_it));
}

// Adds the lines of text below the picture.
double add_notes(Svg& svg, const PathDrawing& drawing, double top, bool all_obstacles) {
  const auto note = [&](const std::string& words, const char* its_colour) {
    svg.text({kMargin, top += kLegendLine}, words, fmt::format("fill=\"{}\" font-size=\"15\"", its_colour));
  };
  note(fmt::format("the certified path, from the ring on: {} collisions", drawing.collisions), kPathColour);
  if (!drawing.other.empty())
    note(fmt::format("{}: another obstacle at collision {}", drawing.other_name, drawing.parting),
         kOtherColour);
  if (!all_obstacles) note("obstacles are left out: there are too many to be seen", "#555");
  return top + kMargin;
}

}  // namespace

std::string draw_path(const PathDrawing& given) {
  PathDrawing drawing = given;
  drawing.scene = with_cells(given.scene);
  if (const auto& v = given.escape)
    drawing.path.push_back(
        plus(given.path.back(), 2 * cell_size(given.scene) / std::hypot((*v)[0], (*v)[1]), *v));
  const PathFrame frame(drawing);
  Svg svg;
  const bool all_obstacles = add_passed_obstacles(svg, drawing, frame);
  if (!drawing.other.empty() && drawing.parting > 0)
    add_path(svg, on_paper(frame, drawing.other, drawing.parting - 1), kOtherColour,
             " stroke-dasharray=\"6 3\"");
  add_path(svg, on_paper(frame, drawing.path), kPathColour, "");
  svg.ellipse(frame(drawing.path[0]), {5, 5, 0},
              fmt::format("fill=\"white\" stroke=\"{}\" stroke-width=\"2\"", kPathColour));
  const double height = add_notes(svg, drawing, frame.height(), all_obstacles);
  return svg.document(std::max(frame.width(), 420.0), height, "path of a particle");
}

}  // namespace lorentz::pictures
