// Pictures: what is in front, what is hidden, what is left out.
#include "pictures/scene_drawing.hpp"

#include <catch2/catch.hpp>

#include "pictures/drawing_parts.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::pictures;

namespace {

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

const std::string kSeen = "stroke=\"#111111\" stroke-width=\"1.6\"/>", kHidden = "stroke-dasharray";

}  // namespace

TEST_CASE("3D: the farthest obstacle first; the eye is in front of the cell, on the side of -y",
          "[pictures][scene_drawing]") {
  Scene scene = unit_scene(3, 0.1);
  scene.lattices[0].atoms = {{{0, 0.25, 0}, 0.1, {}}, {{0, 0.75, 0}, 0.1, {}}};
  const std::string svg = draw_scene(scene, "", {}).svg;
  const std::string kShade = "fill=\"url(#shade";
  CHECK(svg.substr(svg.find(kShade) + kShade.size(), 1) == "1");
  CHECK(svg.substr(svg.rfind(kShade) + kShade.size(), 1) == "0");
}

TEST_CASE("3D: what is in or behind an obstacle is drawn faint", "[pictures][scene_drawing]") {
  CHECK(times(draw_scene(unit_scene(3, 1e-4), "", {}).svg, kHidden) == 0);
  CHECK(times(draw_scene(unit_scene(3, 1e-4), "", {}).svg, kSeen) == 12);
  const std::string half = draw_scene(unit_scene(3, 0.25), "", {}).svg;
  CHECK(times(half, kHidden) >= 24);  // 24 seen; both ends of each edge
  CHECK(times(half, kSeen) >= 8);     // 12 seen
  CHECK(times(draw_scene(unit_scene(3, 0.55), "", {}).svg, kSeen) == 0);
}

TEST_CASE("The outline of a projected ellipsoid", "[pictures][scene_drawing]") {
  // Semiaxes 3 along the line of sight, 2 and 1 across it, turned by 3-4-5.
  const EllipseShape shape = ellipse_of({1.6, -0.6, 0}, {1.2, 0.8, 0});
  CHECK(shape.rx == Approx(2));
  CHECK(shape.ry == Approx(1));
  CHECK(std::tan(shape.angle) == Approx(0.75));
}

TEST_CASE("No picture holds more than a few thousand obstacles", "[pictures][scene_drawing]") {
  Scene scene = unit_scene(2, 0.001);
  scene.lattices[0].atoms.clear();
  for (int i = 0; i < 120 * 120; ++i)
    scene.lattices[0].atoms.push_back({{i % 120 / 120.0, i / 120 / 120.0}, 0.001, {}});
  CHECK(times(draw_scene(scene, "", {}).svg, "<circle") <= kMostDrawn + 20);
  Flight flight{{{0.5, 0.5}, {1, 1e-9}, {}}, Answer::hit({0, 0, {}}, 30)};
  const Drawing drawing = draw_scene(scene, "", {flight});
  CHECK(times(drawing.svg, "<circle") <= kMostDrawn + 20);
  CHECK(drawing.remarks.size() == 1);
}
