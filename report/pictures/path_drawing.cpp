// A particle's path among the obstacles of a 2D scene.
#include <algorithm>

#include <lorentz/geometry.hpp>
#include "report/pictures/drawing_parts.hpp"

namespace lorentz::pictures {
namespace {

constexpr double kLegendLine = 22;
constexpr const char *kPathColour = "#1f5fa8", *kOtherColour = kFlightColour;

PaperWindow window_around(const PathDrawing& drawing) {
  PaperWindow window{{drawing.path[0], drawing.path[0]}};
  const double margin = 0.6 * cell_size(drawing.scene);
  for (const auto* path : {&drawing.path, &drawing.other})
    for (const Vec& place : *path) window.box.include(place, margin);
  constexpr double kPathWidth = 800;
  window.scale = (kPathWidth - 2 * kMargin) / std::max(window.box.width(), window.box.height());
  return window;
}

std::vector<Point> to_paper(const PaperWindow& window, const std::vector<Vec>& path, std::size_t from = 0) {
  std::vector<Point> points;
  for (std::size_t i = from; i < path.size(); ++i) points.push_back(window(path[i]));
  return points;
}

// Adds the obstacles; those at the edge are cut there. False if there are too many.
bool add_passed_obstacles(Svg& svg, const PathDrawing& drawing, const PaperWindow& window) {
  bool cut = false;
  const std::vector<Placed> obstacles = obstacles_in(drawing.scene, window.box, cut);
  if (cut || obstacles.size() > kMostDrawn) return false;
  svg.raw(fmt::format("<clipPath id=\"window\"><rect width=\"{:.2f}\" height=\"{:.2f}\"/></clipPath>\n",
                      2 * kMargin + window.width(), 2 * kMargin + window.height()));
  svg.open("clip-path=\"url(#window)\"");
  for (const Placed& obstacle : obstacles) {
    const Atom& atom = drawing.scene.lattices[obstacle.lattice].atoms[obstacle.atom];
    const Colour& its = colour(colour_index(drawing.scene, obstacle));
    const EllipseShape seen = shadow_of(atom, 2, {1, 0, 0}, {0, -1, 0});
    svg.ellipse(window(obstacle.centre), {window.scale * seen.rx, window.scale * seen.ry, seen.angle},
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
  if (!drawing.other.empty()) note(drawing.other_words, kOtherColour);
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
  const PaperWindow window = window_around(drawing);
  Svg svg;
  const bool all_obstacles = add_passed_obstacles(svg, drawing, window);
  if (!drawing.other.empty() && drawing.parting > 0)
    add_path(svg, to_paper(window, drawing.other, drawing.parting - 1), kOtherColour,
             " stroke-dasharray=\"6 3\"");
  add_path(svg, to_paper(window, drawing.path), kPathColour, "");
  svg.ellipse(window(drawing.path[0]), {5, 5, 0},
              fmt::format("fill=\"white\" stroke=\"{}\" stroke-width=\"2\"", kPathColour));
  const double height = add_notes(svg, drawing, 2 * kMargin + window.height(), all_obstacles);
  return svg.document(std::max(2 * kMargin + window.width(), 420.0), height, "path of a particle");
}

}  // namespace lorentz::pictures
