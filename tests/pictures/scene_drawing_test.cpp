// Pictures: what is in front, what is hidden, what is left out.
#include "report/pictures/scene_drawing.hpp"

#include <catch2/catch.hpp>

#include <lorentz/geometry.hpp>
#include "report/pictures/drawing_parts.hpp"
#include "tests/support/command_line.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::pictures;
using lorentz::test::count_of;

namespace {

const std::string kSeen = "stroke=\"#111111\" stroke-width=\"1.6\"/>", kHidden = "stroke-dasharray";

}  // namespace

TEST_CASE("3D: the farthest obstacle first, the eye is in front of the cell, on the side of -y",
          "[pictures][scene_drawing]") {
  Scene scene = unit_scene(3, 0.1);
  scene.lattices[0].atoms = {{{0, 0.25, 0}, 0.1, {}}, {{0, 0.75, 0}, 0.1, {}}};
  const std::string svg = draw_scene(scene, {}, {}).svg;
  const std::string kShade = "fill=\"url(#shade";
  CHECK(svg.substr(svg.find(kShade) + kShade.size(), 1) == "1");
  CHECK(svg.substr(svg.rfind(kShade) + kShade.size(), 1) == "0");
}

TEST_CASE("3D: what is in or behind an obstacle is drawn faint", "[pictures][scene_drawing]") {
  CHECK(count_of(draw_scene(unit_scene(3, 1e-4), {}, {}).svg, kHidden) == 0);
  CHECK(count_of(draw_scene(unit_scene(3, 1e-4), {}, {}).svg, kSeen) == 12);
  const std::string half = draw_scene(unit_scene(3, 0.25), {}, {}).svg;
  CHECK(count_of(half, kHidden) >= 24);  // 24 seen; both ends of each edge
  CHECK(count_of(half, kSeen) >= 8);     // 12 seen
  CHECK(count_of(draw_scene(unit_scene(3, 0.55), {}, {}).svg, kSeen) == 0);
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
  CHECK(count_of(draw_scene(scene, {}, {}).svg, "<circle") <= kMostDrawn + 20);
  pictures::DrawnFlight flight{{{0.5, 0.5}, {1, 1e-9}, {}}, Answer::hit({0, 0, {}}, 30)};
  const Drawing drawing = draw_scene(scene, {}, {flight});
  CHECK(count_of(drawing.svg, "<circle") <= kMostDrawn + 20);
  CHECK(drawing.remarks.size() == 1);
}

namespace {

// The square lattice, r = 1/10, and flights upwards from (1/2, 1/2) that hit after these lengths.
Drawing with_flights(const std::vector<double>& lengths, const DrawOptions& options = {}) {
  std::vector<pictures::DrawnFlight> flights;
  for (const double length : lengths)
    flights.push_back({{{0.5, 0.5}, {0, 2}, {}}, Answer::hit({0, 0, {}}, length / 2)});
  return draw_scene(unit_scene(2, 0.1), options, flights);
}

// The height of the window in cells: the discs of a column.
double cells_high(const std::string& svg) {
  double x1 = 0, x2 = 0, low = 0, high = 0;
  const auto cell = svg.find("<polygon points=\""), clip = svg.find("<rect x=");
  REQUIRE(std::sscanf(svg.c_str() + cell, "<polygon points=\"%lf,%*f %lf", &x1, &x2) == 2);
  REQUIRE(std::sscanf(svg.c_str() + clip, "<rect x=\"%*f\" y=\"%lf\" width=\"%*f\" height=\"%lf", &low,
                      &high) == 2);
  return high / (x2 - x1);
}

}  // namespace

TEST_CASE("2D: one long flight does not shrink the others", "[pictures][scene_drawing]") {
  std::vector<double> lengths(20, 3.0);
  const double without = cells_high(with_flights(lengths).svg);
  lengths.push_back(35);
  const Drawing with = with_flights(lengths);
  CHECK(cells_high(with.svg) == Approx(without));
  CHECK(count_of(with.svg, "stroke-width=\"1.4\"/>\n<polygon") == 1);  // an arrow, to the window's edge
  REQUIRE(with.remarks.size() == 1);
  CHECK(with.remarks[0] == "flights that go on beyond the picture: 1, the longest for 35");
  // One alone is shown to its end, and so are two of very different length.
  CHECK(cells_high(with_flights({35}).svg) > 35);
  CHECK(cells_high(with_flights({3, 35}).svg) > 35);
  CHECK(with_flights({3, 35}).remarks.empty());
  CHECK(with_flights({3, 45}).remarks.size() == 1);
  // So are three; of four the longest is left out.
  CHECK(with_flights({3, 3, 35}).remarks.empty());
  CHECK(with_flights({3, 3, 3, 35}).remarks.size() == 1);
}

TEST_CASE("2D: the window that is asked for, the size, and what is in it", "[pictures][scene_drawing]") {
  DrawOptions options;
  options.window = {{-0.25, -0.5, 2.75, 1}};
  const std::string svg = draw_scene(unit_scene(2, 0.2), options, {}).svg;
  CHECK(svg.find("viewBox=\"0 0 800 ") != std::string::npos);
  CHECK(count_of(svg, "height=\"376.00\"") == 1);  // (800 - 2 * 24) / 2
  CHECK(count_of(svg, "<circle") == 3 * 2 + 1);    // and one in the legend
  options.width = 500;
  options.height = 300;
  const std::string small = draw_scene(unit_scene(2, 0.2), options, {}).svg;
  CHECK(small.find("viewBox=\"0 0 500 ") != std::string::npos);
  double height = 0;
  REQUIRE(std::sscanf(small.c_str() + small.find("viewBox"), "viewBox=\"0 0 500 %lf", &height) == 1);
  CHECK(height <= 300);
  CHECK(height > 270);
  // A flight through the window: neither its start nor its end is there.
  options.window = {{0.9, 0.2, 1.1, 0.4}};
  const pictures::DrawnFlight flight{{{0.3, 0.3}, {1, 0}, {}}, Answer::hit({0, 0, {}}, 30)};
  const std::string through = draw_scene(unit_scene(2, 0.05), options, {flight}).svg;
  CHECK(count_of(through, "<circle") == 0);
  CHECK(through.find("goes on") != std::string::npos);
  CHECK(through.find("first hit") == std::string::npos);
  CHECK(through.find("cell") == std::string::npos);
  CHECK(through.find("atom 0") == std::string::npos);
}

TEST_CASE("The legend explains what is there, and nothing else", "[pictures][scene_drawing]") {
  const std::string plain = draw_scene(unit_scene(2, 0.2), {}, {}).svg;
  for (const char* word : {"flight", "goes on", "never", "inside", "corridor"})
    CHECK(plain.find(word) == std::string::npos);
  const pictures::DrawnFlight never{{{0.5, 0.5}, {1, 0}, {}}, Answer::never()};
  const std::string flies = draw_scene(unit_scene(2, 0.2), {}, {never}).svg;
  CHECK(flies.find(">never hits<") != std::string::npos);
  CHECK(flies.find("first hit") == std::string::npos);
  DrawOptions options;
  options.title = "A title";
  CHECK(count_of(draw_scene(unit_scene(3, 0.2), options, {}).svg, "A title") == 2);  // and the document's
}

TEST_CASE("3D: the cube of fcc and bcc, turned ones too, and no cube of others",
          "[pictures][scene_drawing]") {
  const auto cell_of = [](const std::array<Vec, 3>& vectors) {
    const Lattice lattice{vectors, {{{}, 0.1, {}}}};
    return shown_cell(lattice);
  };
  const std::array<Vec, 3> fcc{Vec{0, 0.5, 0.5}, Vec{0.5, 0, 0.5}, Vec{0.5, 0.5, 0}},
      bcc{Vec{-0.5, 0.5, 0.5}, Vec{0.5, -0.5, 0.5}, Vec{0.5, 0.5, -0.5}},
      unit{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  CHECK(cell_of(fcc).primitive_cells == 4);
  CHECK(cell_of(fcc).vectors == unit);
  CHECK(cell_of(bcc).primitive_cells == 2);
  CHECK(cell_of(bcc).vectors == unit);
  CHECK(cell_of(unit).primitive_cells == 1);
  // In a skewed basis, and turned by 3-4-5 about z.
  CHECK(cell_of({fcc[0], sum(fcc[1], scaled(fcc[0], 2)), sum(fcc[2], scaled(fcc[1], -3))}).vectors == unit);
  auto turned = bcc;
  for (Vec& u : turned) u = {0.6 * u[0] - 0.8 * u[1], 0.8 * u[0] + 0.6 * u[1], u[2]};
  const ShownCell cube = cell_of(turned);
  CHECK(cube.primitive_cells == 2);
  for (const Vec& edge : cube.vectors) CHECK(length(edge) == Approx(1));
  // Hexagonal, and face-centred but a thousandth too long.
  CHECK(cell_of({Vec{1, 0, 0}, Vec{-0.5, std::sqrt(0.75), 0}, Vec{0, 0, 1.6}}).primitive_cells == 1);
  CHECK(cell_of({Vec{0, 0.5, 0.5005}, Vec{0.5, 0, 0.5005}, Vec{0.5, 0.5, 0}}).primitive_cells == 1);
  // Two edges at 30 degrees, and half the cube's volume: no two of the three right angles make a cube.
  const Vec a{1, 0, 0}, b{std::sqrt(0.75), 0.5, 0}, up{0, 0, 1};
  for (const auto& prism : {std::array{a, b, up}, {a, up, b}, {up, a, b}})
    CHECK(cell_of(prism).primitive_cells == 1);
  // In the picture: the corners and the middles of the faces; of bcc, the middle.
  Scene scene = unit_scene(3, 0.1);
  scene.lattices[0].vectors = fcc;
  CHECK(count_of(draw_scene(scene, {}, {}).svg, "url(#shade") == 14);
  CHECK(draw_scene(scene, {}, {}).svg.find("the cube of 4 primitive cells") != std::string::npos);
  scene.lattices[0].vectors = bcc;
  CHECK(count_of(draw_scene(scene, {}, {}).svg, "url(#shade") == 9);
}

TEST_CASE("Corridors are where they are", "[pictures][scene_drawing]") {
  DrawOptions options;
  options.window = {{0, 0, 3, 3}};
  options.ways = {{{0, 0.5}, {1, 0}, 0.6, "corridor [1 0]"}};
  const std::string flat = draw_scene(unit_scene(2, 0.2), options, {}).svg;
  CHECK(count_of(flat, std::string("fill=\"") + way_colour(0) + "\" fill-opacity=\"0.2\"") == 3);
  CHECK(count_of(flat, "corridor [1 0]") == 1);
  // The rows between the discs, 752 pixels for 3 cells.
  double y1 = 0, y2 = 0;
  const auto strip = flat.rfind("<polygon points=", flat.find("fill-opacity=\"0.2\""));
  REQUIRE(std::sscanf(flat.c_str() + strip, "<polygon points=\"%*f,%lf %*f,%*f %*f,%lf", &y1, &y2) == 2);
  CHECK(std::fabs(y1 - y2) == Approx(0.6 * 752 / 3).margin(0.02));
}
