// Pictures of plane scenes, measured: each obstacle, flight and corridor is where it is, and as large as it
// is.
#include <fmt/format.h>

#include <set>

#include <lorentz/oracle.hpp>
#include "report/pictures/scene_drawing.hpp"
#include "tests/pictures/crowd.hpp"

using namespace lorentz;
using namespace lorentz::pictures;
using namespace lorentz::test;

TEST_CASE("2D: every obstacle in the window is drawn, once, as it is", "[pictures][scene_drawing]") {
  DrawOptions options;
  options.window = {{-1.7, 0.3, 2.1, 2.4}};
  options.title = "A crowd";
  const SvgPicture picture(draw_scene(crowd(), options, {}).svg);
  CHECK(picture.title == "A crowd");
  std::set<std::pair<double, double>> places;  // no text on another
  for (const Ink& text : picture.all("text")) CHECK(places.emplace(text.centre.x, text.centre.y).second);
  CHECK(picture.beyond_page() == "");
  const Inks drawn = drawn_obstacles(picture);
  REQUIRE(drawn.size() > 20);
  const Rectangle seen = *drawn[0].clip;
  CHECK(seen.width() == Approx(800 - 48));
  CHECK(seen.height() / seen.width() == Approx(2.1 / 3.8).epsilon(1e-4));
  const Plane plane = plane_of(seen, *options.window);
  check_drawn(picture, drawn, plane, within(obstacles_of(crowd(), 8, kCrowd), *options.window));
  std::set<std::string> colours;
  for (const std::string& name : kCrowd) colours.insert(picture.mark_of(name)["fill"]);
  CHECK(colours.size() == 4);

  // The cell that holds the window's middle, (0.2, 1.35): with coordinates (0.61, 1.36) it is (0, 1).
  const Inks cells = clipped(picture, "polygon", "stroke", kCell);
  REQUIRE(cells.size() == 1);
  const Spot corners[] = {{-0.3, 0.9}, {0.7, 1.1}, {0.4, 2}, {-0.6, 1.8}};
  for (int i = 0; i < 4; ++i) CHECK(same_place(cells[0].points[i], corners[i], plane));
  CHECK(picture.mark_of("a cell of lattice 0")["stroke"] == kCell);

  // The grid: through each point of the lattice in the window a line either way.
  for (int i = -4; i <= 4; ++i)
    for (int k = -4; k <= 4; ++k) {
      const Spot at{i - 0.3 * k, 0.2 * i + 0.9 * k};
      if (!Rectangle{{-1.7, 0.3}, {2.1, 2.4}}.holds(at)) continue;
      std::multiset<int> through;
      for (const Ink& line : clipped(picture, "line", "stroke", kGrid)) {
        const Spot a = plane(line.points[0]), way = plane(line.points[1]) - a, arm = at - a;
        const double size = std::hypot(way.x, way.y), along = (way.x * arm.x + way.y * arm.y) / size / size;
        if (std::fabs(way.x * arm.y - way.y * arm.x) / size * plane.scale > 0.05 || along < 0 || along > 1)
          continue;
        if (std::fabs(way.x * 0.2 - way.y) < 0.001 * size) through.insert(0);
        if (std::fabs(way.x * 0.9 + way.y * 0.3) < 0.001 * size) through.insert(1);
      }
      CHECK(through == std::multiset<int>{0, 1});
    }
}

TEST_CASE("2D: without a window the cell is in its middle, and all flights in it",
          "[pictures][scene_drawing]") {
  const SvgPicture picture(draw_scene(crowd(), {}, {}).svg);
  CHECK(picture.beyond_page() == "");
  const Ink cell = clipped(picture, "polygon", "stroke", kCell).at(0);
  const Plane plane{cell.points[0], distance(cell.points[0], cell.points[1]) / std::hypot(1, 0.2)};
  CHECK(same_place(cell.points[1], {1, 0.2}, plane));
  CHECK(same_place(cell.points[3], {-0.3, 0.9}, plane));
  const Rectangle seen = *cell.clip;
  const Spot low = plane(Spot{seen.low.x, seen.high.y}), high = plane(Spot{seen.high.x, seen.low.y});
  const double half = 2 * std::sqrt(0.96);  // four cells of lattice 0, about its cell's middle (0.35, 0.55)
  CHECK(low.x == Approx(0.35 - half).margin(1e-3));
  CHECK(low.y == Approx(0.55 - half).margin(1e-3));
  CHECK(high.x == Approx(0.35 + half).margin(1e-3));
  CHECK(high.y == Approx(0.55 + half).margin(1e-3));
  check_drawn(picture, drawn_obstacles(picture), plane,
              within(obstacles_of(crowd(), 8, kCrowd), {low.x, low.y, high.x, high.y}));
  // Flights down and to the left: all of them, and 0.6 cells beyond.
  std::vector<pictures::DrawnFlight> flights;
  for (const Vec& end : {Vec{0.4, -6}, Vec{-5, 0.3}})
    flights.push_back({{{0.4, 0.3}, {end[0] - 0.4, end[1] - 0.3}, {}}, Answer::hit({0, 0, {}}, 1)});
  flights.push_back({{{7, 0.4}, {-1, 0}, {}}, Answer::hit({0, 0, {}}, 1)});
  const SvgPicture far(draw_scene(crowd(), {}, flights).svg);
  CHECK(far.beyond_page() == "");
  const Inks starts = clipped(far, "ellipse", "fill", "white"),
             ends = clipped(far, "ellipse", "fill", kFlight);
  REQUIRE(starts.size() == 3);
  REQUIRE(ends.size() == 3);
  const Plane wide{{starts[0].centre.x, starts[0].centre.y}, (ends[0].centre.y - starts[0].centre.y) / 6.3};
  CHECK(same_place(ends[0].centre, {0, -6.3}, wide));
  CHECK(same_place(ends[1].centre, {-5.4, 0}, wide));
  const Rectangle whole = *starts[0].clip;
  CHECK(wide(whole.low).x == Approx(-5.4 - 0.6 * std::sqrt(0.96)).margin(1e-3));
  CHECK(wide(whole.high).x == Approx(6.6 + 0.6 * std::sqrt(0.96)).margin(1e-3));
  CHECK(wide(whole.high).y == Approx(-6.3 - 0.6 * std::sqrt(0.96)).margin(1e-3));
}

TEST_CASE("2D: flights begin at x, go along v, and end on the surface of what they hit",
          "[pictures][scene_drawing]") {
  const Scene scene = crowd();
  DrawOptions options;
  options.window = {{-2.5, -1.5, 3, 2.25}};
  std::vector<pictures::DrawnFlight> flights;
  for (const Query& query : {Query{{0.6, 0.1}, {-2, 1.1}, {}}, Query{{-1, 0.9}, {0.3, 0.35}, {}},
                             Query{{1.2, -0.8}, {-0.1, 3}, {}}})
    flights.push_back({query, oracle::Oracle(scene).first_hit(query)});
  const Query rising{{0.8, 1.4}, {0.5, 2}, {}}, beyond{{-4.5, -2.5}, {2, 1}, {}},
      within_disc{{0.1, 0.1}, {1, 0}, {}};
  flights.push_back({rising, Answer::never()});
  flights.push_back({beyond, Answer::hit({0, 0, {}}, 1e6)});  // only through the window
  flights.push_back({within_disc, Answer::inside({0, 0, {0, 0}})});
  const SvgPicture picture(draw_scene(scene, options, flights).svg);
  CHECK(picture.beyond_page() == "");
  const Plane plane = plane_of(*drawn_obstacles(picture).at(0).clip, *options.window);
  const Inks starts = clipped(picture, "ellipse", "fill", "white"),
             lines = clipped(picture, "line", "stroke", kFlight),
             ends = clipped(picture, "ellipse", "fill", kFlight),
             rims = picture.all("ellipse", [](const Ink&ink) {
               return ink.is("stroke", kFlight) && !ink.is("fill", "white");
             });
  REQUIRE(starts.size() == 5);
  REQUIRE(ends.size() == 4);
  REQUIRE(rims.size() == 4);
  for (int i = 0; i < 3; ++i) {
    const auto& [query, answer] = flights[i];
    REQUIRE(answer.outcome == Outcome::hit);
    const Vec end = sum(query.x, scaled(query.v, *answer.time)), centre = centre_of(scene, answer.obstacle);
    const Atom& atom = scene.lattices[answer.obstacle.lattice].atoms[answer.obstacle.atom];
    CHECK(same_place(starts[i].centre, spot(query.x), plane));
    CHECK(same_place(ends[i].centre, spot(end), plane));
    CHECK(has_ends(lines[i], spot(query.x), spot(end), plane));
    CHECK(same_place(rims[i].centre, spot(centre), plane));
    CHECK(same_oval(rims[i].oval, shadow(atom, 2, {1, 0, 0}, {0, 1, 0}), plane));
    const Spot seen = plane(ends[i].centre), middle = plane(rims[i].centre);
    CHECK(off_surface(atom, {middle.x, middle.y}, {seen.x, seen.y}, 2) < 1e-2);
    CHECK(rims[i]["stroke-width"] == "2");
    CHECK(rims[i]["fill"] ==
          picture.mark_of(kCrowd[2 * answer.obstacle.lattice + answer.obstacle.atom])["fill"]);
  }
  // Upwards to y = 2.25; in through x = -2.5, out through y = 1.25.
  CHECK(has_arrow(picture, {0.8, 1.4}, {0.8 + 0.5 * 0.85 / 2, 2.25}, plane));
  CHECK(has_arrow(picture, {-2.5, -1.5}, {3, 1.25}, plane));
  CHECK(same_place(ends[3].centre, {0.1, 0.1}, plane));
  CHECK(same_place(starts[3].centre, {0.8, 1.4}, plane));
  CHECK(picture.mark_of("flight to its first hit").radius() == Approx(2.6));
  CHECK(picture.mark_of("flight to its first hit").centre.y ==
        Approx(picture.text("flight to its first hit").centre.y - 4.5));
  CHECK(picture.mark_of("goes on, or never hits")["fill"] == kFlight);
  CHECK(picture.mark_of("starts inside")["fill"] == kFlight);
}

TEST_CASE("2D: an arrow's direction is the flight's, in every quadrant", "[pictures][scene_drawing]") {
  DrawOptions options;
  options.window = {{-1, -2, 3, 1}};
  const double degrees = GENERATE(20, 100, 200, 290);
  const double turn = degrees * std::acos(-1) / 180, c = std::cos(turn), s = std::sin(turn);
  const SvgPicture picture(
      draw_scene(unit_scene(2, 0.1), options, {{{{0.5, 0.25}, {3 * c, 3 * s}, {}}, Answer::never()}}).svg);
  const Plane plane = plane_of(*drawn_obstacles(picture).at(0).clip, *options.window);
  const double t = std::min((c > 0 ? 2.5 : -1.5) / c, (s > 0 ? 0.75 : -2.25) / s);
  CHECK(has_arrow(picture, {0.5, 0.25}, {0.5 + t * c, 0.25 + t * s}, plane));
  CHECK(picture.mark_of("never hits")["fill"] == kFlight);
}

TEST_CASE("2D: obstacles too small to be seen are dots, which is said", "[pictures][scene_drawing]") {
  DrawOptions options;
  options.window = {{-0.5, -0.5, 2.5, 1.5}};
  Scene scene = unit_scene(2, 0.2);
  CHECK_FALSE(SvgPicture(draw_scene(scene, options, {}).svg).says("smaller"));
  scene.lattices[0].atoms.push_back({{0.5, 0.25, 0}, 0.001, {}});
  const SvgPicture picture(draw_scene(scene, options, {}).svg);
  CHECK(picture.says("The obstacles are smaller than they are drawn."));
  std::map<int, int> sizes;
  for (const Ink& ink : drawn_obstacles(picture)) ++sizes[static_cast<int>(std::round(10 * ink.radius()))];
  CHECK(sizes == std::map<int, int>{{20, 8}, {501, 6}});  // 0.2 of 752 / 3
}

TEST_CASE("2D: corridors are drawn along their vector, as wide as they are, with their translates",
          "[pictures][scene_drawing]") {
  // Along [1 1] of the square lattice: 1 / sqrt(2) apart, 1/sqrt(2) - 2 r wide; along [0 1]; both obliquely
  // placed.
  const double width = std::sqrt(0.5) - 0.2;
  DrawOptions options;
  options.window = {{-1, 0, 3, 2.5}};
  options.ways = {{{3.25, -2.75}, {1, 1}, width, "corridor [1 1]"},
                  {{7.4, 100}, {0, -1}, 0.6, "corridor [0 1]"}};
  const SvgPicture picture(draw_scene(unit_scene(2, 0.1), options, {}).svg);
  CHECK(picture.beyond_page() == "");
  const Plane plane = plane_of(*drawn_obstacles(picture).at(0).clip, *options.window);
  std::map<std::string, std::multiset<int>> strips;  // by colour, at which multiple of the period
  for (const Ink& strip : clipped(picture, "polygon", "fill-opacity", "0.2")) {
    const bool first = strip["fill"] == picture.mark_of("corridor [1 1]")["fill"];
    const Spot across = first ? Spot{-std::sqrt(0.5), std::sqrt(0.5)} : Spot{1, 0};
    const double half = first ? width / 2 : 0.3, period = first ? std::sqrt(0.5) : 1;
    const double at = first ? -3 * std::sqrt(2) : 7.4;  // of the middle line
    CHECK(strip["fill"] == strip["stroke"]);
    double low = 1e9, high = -1e9, back = 1e9, front = -1e9;
    for (const Spot corner : strip.points) {
      const Spot p = plane(corner);
      const double beside = p.x * across.x + p.y * across.y, along = p.x * across.y - p.y * across.x;
      low = std::min(low, beside), high = std::max(high, beside);
      back = std::min(back, along), front = std::max(front, along);
    }
    CHECK(high - low == Approx(2 * half).margin(1e-3));
    const double n = ((high + low) / 2 - at) / period;
    CHECK(n == Approx(std::round(n)).margin(1e-3));
    strips[strip["fill"]].insert(static_cast<int>(std::round(n)));
    for (const Spot p : {Spot{-1, 0}, {3, 0}, {-1, 2.5}, {3, 2.5}}) {  // it reaches across the window
      const double beside = p.x * across.x + p.y * across.y, along = p.x * across.y - p.y * across.x;
      if (beside < low || beside > high) continue;
      CHECK(back < along);
      CHECK(front > along);
    }
  }
  // x = 7.4 - 8 +- 0.3 to 7.4 - 4 - 0.3 > 3: seven translates but the last.
  CHECK(strips[picture.mark_of("corridor [0 1]")["fill"]] == std::multiset<int>{-8, -7, -6, -5});
  // (y - x) / sqrt(2) from -3 / sqrt(2) to 3.5 / sqrt(2), in steps of 1 / sqrt(2) from -3 sqrt(2).
  std::multiset<int> all;
  for (int n = -20; n <= 20; ++n) {
    const double middle = (-6 + n) * std::sqrt(0.5);
    if (middle + width / 2 > -3 * std::sqrt(0.5) && middle - width / 2 < 3.5 * std::sqrt(0.5)) all.insert(n);
  }
  CHECK(strips[picture.mark_of("corridor [1 1]")["fill"]] == all);
  // With two lattices the translates are unknown: one strip; and what lies beside the window is not drawn.
  Scene two = unit_scene(2, 0.1);
  two.lattices.push_back(two.lattices[0]);
  options.ways[0].point = {1, 1.5};
  const SvgPicture both(draw_scene(two, options, {}).svg);
  CHECK(clipped(both, "polygon", "fill-opacity", "0.2").size() == 2);
  CHECK(both.says("corridor [1 1]"));
  CHECK_FALSE(both.says("corridor [0 1]"));
}

TEST_CASE("Windows that are tall, lattices by long vectors, needles", "[pictures][scene_drawing]") {
  DrawOptions options;
  options.window = {{-0.5, -0.5, 0.5, 7.5}};
  Scene scene = unit_scene(2, 0.2);
  scene.lattices[0].vectors[1] = {1e6, 1, 0};  // the square lattice still
  scene.lattices[0].atoms.push_back({{0.2, 0.5, 0}, 0, {{0.1, 0, 0}, {0, 0.001, 0}}});
  const Drawing drawing = draw_scene(scene, options, {});
  CHECK(drawing.remarks.empty());
  const SvgPicture picture(drawing.svg);
  CHECK(picture.beyond_page() == "");
  const Inks drawn = drawn_obstacles(picture);
  const Rectangle seen = *drawn.at(0).clip;
  CHECK(seen.height() == Approx(1000));
  CHECK(seen.low.x + seen.high.x == Approx(800));
  CHECK(drawn.size() == 17);  // 8 discs, 9 needles
  for (const Ink& ink : drawn)
    CHECK(std::sqrt(ink.oval.xx) == Approx(125 * (ink.radius() > 0 ? 0.2 : 0.1)).epsilon(1e-3));
  CHECK_FALSE(picture.says("smaller"));
}
