// Pictures of scenes, measured: each obstacle, flight and free way is where it is, and as large as it is.
#include <fmt/format.h>

#include <set>

#include <lorentz/oracle.hpp>
#include "pictures/path_drawing.hpp"
#include "pictures/scene_drawing.hpp"
#include "src/problem/scene_geometry.hpp"
#include "tests/pictures/measures.hpp"

using namespace lorentz;
using namespace lorentz::pictures;
using namespace lorentz::test;

namespace {

constexpr const char *kFlight = "#c0182b", *kCell = "#222222", *kGrid = "#dcdcdc";

// Two lattices, one turned, with two atoms each; ellipses by axes that are not at right angles.
Scene crowd() {
  Scene scene = unit_scene(2, 0.12);
  scene.lattices[0].vectors = {Vec{1, 0.2, 0}, Vec{-0.3, 0.9, 0}, Vec{}};
  scene.lattices[0].atoms = {{{0.1, 0.05, 0}, 0.12, {}},
                             {{0.55, 0.5, 0}, 0, {{0.2, 0.1, 0}, {-0.02, 0.07, 0}}}};
  scene.lattices.push_back(
      {{Vec{1.04, 0.78, 0}, Vec{-0.78, 1.04, 0}, Vec{}},
       {{{0.3, 0.4, 0}, 0, {{0.03, 0.15, 0}, {0.06, 0, 0}}}, {{-0.2, 0.1, 0}, 0.05, {}}}});
  return scene;
}
// Semiaxes by hand: the eigenvalues of A A^T.
const std::vector<std::string> kCrowd{
    "lattice 0, atom 0: radius 0.12", "lattice 0, atom 1: semiaxes 0.2241, 0.07141",
    "lattice 1, atom 0: semiaxes 0.1535, 0.05863", "lattice 1, atom 1: radius 0.05"};

// Those whose square (of the longest semiaxis) reaches into the window.
std::vector<Wanted> within(std::vector<Wanted> all, const std::array<double, 4>& window) {
  std::erase_if(all, [&](const Wanted& one) {
    const auto [xx, xy, yy] = one.oval;
    const double reach = std::sqrt((xx + yy) / 2 + std::hypot((xx - yy) / 2, xy));
    return !Rectangle{{window[0], window[1]}, {window[2], window[3]}}.holds(one.centre, reach);
  });
  return all;
}

Inks clipped(const SvgPicture& picture, const std::string& kind, const std::string& attribute = "",
             const std::string& value = "") {
  return picture.all(
      kind, [&](const Ink& ink) { return ink.clip && (attribute.empty() || ink.is(attribute, value)); });
}

// Obstacles of a plane scene: they are see-through, unless they are hit.
Inks drawn_obstacles(const SvgPicture& picture) {
  return clipped(picture, "ellipse", "fill-opacity", "0.7");
}

Spot spot(const Vec& a) {
  return {a[0], a[1]};
}

// How far a spot is from an obstacle's surface, in its radii about.
double off_surface(const Atom& atom, const Vec& centre, const Vec& place, int dimension) {
  Vec y{};
  const auto rows = dual_of(semiaxes_of(atom, dimension), dimension);
  for (int i = 0; i < dimension; ++i) y[i] = dot(rows[i], sum(place, scaled(centre, -1)));
  return std::fabs(length(y) - 1);
}

bool has_ends(const Ink& line, Spot a, Spot b, const Plane& plane) {
  return same_place(line.points.front(), a, plane) && same_place(line.points.back(), b, plane);
}

// The only arrow whose tip is there; it points along v, its head is 11 long.
bool has_arrow(const SvgPicture& picture, Spot from, Spot to, const Plane& plane) {
  int heads = 0;
  for (const Ink& head : picture.all("polygon", "fill", kFlight)) {
    if (!same_place(head.points[0], to, plane)) continue;
    const Spot a = head.points[1], b = head.points[2], neck{(a.x + b.x) / 2, (a.y + b.y) / 2};
    const Spot way = to - from, back = plane(neck) - to;
    const double along = (way.x * back.x + way.y * back.y) / std::hypot(way.x, way.y) * plane.scale,
                 beside = (way.x * back.y - way.y * back.x) / std::hypot(way.x, way.y) * plane.scale;
    const Spot across = plane(a) - plane(b);
    const double skew = (across.x * way.x + across.y * way.y) / std::hypot(way.x, way.y) * plane.scale;
    int shafts = 0;
    for (const Ink& line : picture.all("line", "stroke", kFlight))
      shafts += has_ends(line, from, plane(neck), plane);
    heads += std::fabs(along + 11) < 0.03 && std::fabs(beside) < 0.03 && std::fabs(skew) < 0.03 &&
             std::fabs(distance(a, b) - 2 * 0.38 * 11) < 0.03 && shafts == 1;
  }
  return heads == 1;
}

}  // namespace

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
  std::vector<Flight> flights;
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
  std::vector<Flight> flights;
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
  options.ways = {{FreeWay::Kind::corridor, {3.25, -2.75}, {1, 1}, width, "corridor [1 1]"},
                  {FreeWay::Kind::corridor, {7.4, 100}, {0, -1}, 0.6, "corridor [0 1]"}};
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
  // Of two lattices nobody knows the translates: one strip; and what is beside the window is not there.
  Scene two = unit_scene(2, 0.1);
  two.lattices.push_back(two.lattices[0]);
  options.ways[0].point = {1, 1.5};
  const SvgPicture both(draw_scene(two, options, {}).svg);
  CHECK(clipped(both, "polygon", "fill-opacity", "0.2").size() == 2);
  CHECK(both.says("corridor [1 1]"));
  CHECK_FALSE(both.says("corridor [0 1]"));
}

namespace {

// The eye: from a little to the right of the y axis and above, turned by 0.42, raised by 0.31.
const double kTurn = 0.42, kRise = 0.31;
const Vec kRight{std::cos(kTurn), std::sin(kTurn), 0},
    kUp{-std::sin(kTurn) * std::sin(kRise), std::cos(kTurn) * std::sin(kRise), std::cos(kRise)},
    kTowards{std::sin(kTurn) * std::cos(kRise), -std::cos(kTurn) * std::cos(kRise), std::sin(kRise)};

Spot seen(const Vec& place) {
  return {dot(kRight, place), dot(kUp, place)};
}

Inks balls_of(const SvgPicture& picture) {
  return picture.all("ellipse", [](const Ink& ink) { return ink["fill"].find("url(#shade") == 0; });
}

// Where the inks are, if their middles are those of the wanted ones.
Plane fitted(const Inks& drawn, const std::vector<Wanted>& wanted) {
  Rectangle paper{{1e9, 1e9}, {-1e9, -1e9}}, data = paper;
  const auto include = [](Rectangle& box, Spot p) {
    box = {{std::min(box.low.x, p.x), std::min(box.low.y, p.y)},
           {std::max(box.high.x, p.x), std::max(box.high.y, p.y)}};
  };
  for (const Ink& ink : drawn) include(paper, ink.centre);
  for (const Wanted& one : wanted) include(data, one.centre);
  const double scale = paper.width() / data.width();
  return {{paper.low.x - scale * data.low.x, paper.high.y + scale * data.low.y}, scale};
}

// The block of `cells` along each edge, its boundary included.
std::vector<Wanted> in_block(std::vector<Wanted> all, const std::array<Vec, 3>& vectors, const Vec& corner,
                             double cells) {
  const auto rows = dual_of(vectors, 3);
  std::erase_if(all, [&](const Wanted& one) {
    for (const Vec& row : rows)
      if (const double n = dot(row, sum(one.place, scaled(corner, -1))); n < -1e-6 || n > cells + 1e-6)
        return true;
    return false;
  });
  return all;
}

Scene crowd_in_space() {
  Scene scene = unit_scene(3, 0.1);
  scene.lattices[0].vectors = {Vec{1, 0.1, 0}, Vec{-0.2, 0.9, 0.1}, Vec{0.1, 0, 1.2}};
  scene.lattices[0].atoms = {{{0.1, 0.2, 0.05}, 0, {{0.2, 0.1, 0}, {-0.02, 0.07, 0.05}, {0, 0.03, 0.12}}},
                             {{0.5, 0.6, 0.5}, 0.08, {}}};
  scene.lattices.push_back(
      {{Vec{1.1, 0, 0.2}, Vec{0, 1.3, 0}, Vec{0, 0.3, 0.9}}, {{{0.25, 0.9, 0.3}, 0.06, {}}}});
  return scene;
}

// True if some obstacle is between the place and the eye, or around it; `slack` from the edge nobody says.
std::optional<bool> hidden(const Scene& scene, const std::vector<Wanted>& obstacles,
                           const std::vector<std::string>& names, const Vec& place, double slack) {
  std::vector<const Atom*> atoms;
  for_each_atom(scene, [&](const Atom& atom) { atoms.push_back(&atom); });
  bool is = false;
  for (const Wanted& one : obstacles) {
    const Atom& atom = *atoms[std::find(names.begin(), names.end(), one.name) - names.begin()];
    const auto rows = dual_of(semiaxes_of(atom, 3), 3);
    Vec w{}, d{};
    for (int i = 0; i < 3; ++i) {
      w[i] = dot(rows[i], sum(place, scaled(one.place, -1)));
      d[i] = dot(rows[i], kTowards);
    }
    const double s = std::max(0.0, -dot(w, d) / dot(d, d)), least = length(sum(w, scaled(d, s)));
    if (std::fabs(least - 1) < slack) return std::nullopt;
    is |= least < 1;
  }
  return is;
}

}  // namespace

TEST_CASE("3D: every obstacle of the block is drawn, once, as it is seen, the farthest first",
          "[pictures][scene_drawing]") {
  const Scene scene = crowd_in_space();
  const std::vector<std::string> names{"", "lattice 0, atom 1: radius 0.08",
                                       "lattice 1, atom 0: radius 0.06"};
  const SvgPicture picture(draw_scene(scene, {}, {}).svg);
  CHECK(picture.beyond_page() == "");
  std::vector<std::string> full = names;
  for (const Ink& ink : picture.all("text"))
    if (ink.words.find("lattice 0, atom 0: semiaxes ") == 0) full[0] = ink.words;
  const auto axes = principal_semiaxes(scene.lattices[0].atoms[0], 3);
  CHECK(full[0] ==
        fmt::format("lattice 0, atom 0: semiaxes {:.4g}, {:.4g}, {:.4g}", axes[0], axes[1], axes[2]));
  const auto wanted = in_block(obstacles_of(scene, 5, full, kRight, kUp), scene.lattices[0].vectors, {}, 2);
  const Inks drawn = balls_of(picture);
  const Plane plane = fitted(drawn, wanted);
  check_drawn(picture, drawn, plane, wanted);
  double last = -1e9;
  for (const Ink& ink : drawn)
    for (const Wanted& one : wanted)
      if (same_place(ink.centre, one.centre, plane) && same_oval(ink.oval, one.oval, plane)) {
        CHECK(dot(kTowards, one.place) >= last);
        last = dot(kTowards, one.place);
      }
  // The edges of the cell, from the origin: each in pieces from end to end, faint where it is hidden.
  int faint = 0, full_pieces = 0, unsure = 0;
  const auto& u = scene.lattices[0].vectors;
  for (int i = 0; i < 3; ++i)
    for (int n = 0; n < 4; ++n) {
      const Vec from = sum(scaled(u[(i + 1) % 3], n & 1), scaled(u[(i + 2) % 3], n >> 1));
      const Spot a = seen(from), way = seen(u[i]);
      const double size = std::hypot(way.x, way.y);
      double covered = 0;
      for (const Ink& line : picture.all("line", "stroke", "#111111")) {
        const Spot p = plane(line.points[0]) - a, q = plane(line.points[1]) - a;
        const auto beside = [&](Spot s) { return std::fabs(s.x * way.y - s.y * way.x) / size * plane.scale; };
        const double first = (p.x * way.x + p.y * way.y) / size / size,
                     end = (q.x * way.x + q.y * way.y) / size / size;
        if (beside(p) > 0.02 || beside(q) > 0.02 || first < -1e-3 || end > 1 + 1e-3) continue;
        covered += end - first;
        const bool is_faint = !line["stroke-dasharray"].empty();
        for (const double share : {0.02, 0.3, 0.5, 0.8, 0.98}) {
          const Vec place = sum(from, scaled(u[i], first + share * (end - first)));
          const auto is_hidden = hidden(scene, wanted, full, place, 0.12);
          if (is_hidden) CHECK(*is_hidden == is_faint);
          unsure += !is_hidden;
        }
        ++(is_faint ? faint : full_pieces);
      }
      CHECK(covered == Approx(1).margin(1e-3));
    }
  CHECK(faint > 5);
  CHECK(full_pieces > 12);
  CHECK(unsure < 200);
}

TEST_CASE("3D: flights begin at x and end on what they hit, the others go on", "[pictures][scene_drawing]") {
  const Scene scene = crowd_in_space();
  const std::vector<std::string> names{"0", "1", "2"};
  std::vector<Flight> flights;
  for (const Query& query :
       {Query{{0.5, 0.1, 0.6}, {1, 0.7, -0.35}, {}}, Query{{0.3, 0.5, 1.1}, {-0.4, 0.5, 0.2}, {}}})
    flights.push_back({query, oracle::Oracle(scene).first_hit(query)});
  flights.push_back({{{0.9, 0.5, 0.3}, {0, 0.3, 2}, {}}, Answer::never()});
  const SvgPicture picture(draw_scene(scene, {}, flights).svg);
  CHECK(picture.beyond_page() == "");
  const Inks starts = picture.all("ellipse", "fill", "white"),
             ends = picture.all("ellipse", [](const Ink&ink) {
               return ink.is("fill", kFlight) && std::fabs(ink.radius() - 2.8) < 1e-9;
             });
  REQUIRE(starts.size() == 3);
  REQUIRE(ends.size() == 2);
  const Spot a = seen(flights[0].query.x),
             b = seen(sum(flights[0].query.x, scaled(flights[0].query.v, *flights[0].answer.time)));
  const double scale = distance(starts[0].centre, ends[0].centre) / distance(a, b);
  const Plane plane{{starts[0].centre.x - scale * a.x, starts[0].centre.y + scale * a.y}, scale};
  for (int i = 0; i < 3; ++i) CHECK(same_place(starts[i].centre, seen(flights[i].query.x), plane));
  // What is in the block that begins at the first flight's cell, and what is hit.
  auto wanted = in_block(obstacles_of(scene, 5, names, kRight, kUp), scene.lattices[0].vectors, {}, 2);
  const Inks balls = balls_of(picture);
  std::size_t beyond = 0, rims = 0;
  for (int i = 0; i < 2; ++i) {
    const auto& [query, answer] = flights[i];
    REQUIRE(answer.outcome == Outcome::hit);
    const Vec end = sum(query.x, scaled(query.v, *answer.time)), centre = centre_of(scene, answer.obstacle);
    const Atom& atom = scene.lattices[answer.obstacle.lattice].atoms[answer.obstacle.atom];
    CHECK(same_place(ends[i].centre, seen(end), plane));
    CHECK(off_surface(atom, centre, end, 3) < 1e-9);
    const auto is_it = [&](const Wanted& one) { return length(sum(one.place, scaled(centre, -1))) < 1e-9; };
    if (std::none_of(wanted.begin(), wanted.end(), is_it)) {
      ++beyond;
      wanted.push_back({seen(centre), shadow(atom, 3, kRight, kUp),
                        names[2 * answer.obstacle.lattice + answer.obstacle.atom], centre});
    }
    for (const Ink& ball : balls)
      rims += ball.is("stroke", kFlight) && ball.is("stroke-width", "2.2") &&
              same_place(ball.centre, seen(centre), plane) &&
              same_oval(ball.oval, shadow(atom, 3, kRight, kUp), plane);
    const auto behind = hidden(scene, wanted, names, sum(end, scaled(query.v, -0.01)), 0.02);
    if (behind && !hidden(scene, wanted, names, end, 1e-9).value_or(false))
      CHECK(ends[i]["fill-opacity"] == (*behind ? "0.3" : "1"));
  }
  CHECK(rims == 2);
  CHECK(balls.size() == wanted.size());
  for (const Wanted& one : wanted)
    CHECK(std::count_if(balls.begin(), balls.end(), [&](const Ink& ball) {
            return same_place(ball.centre, one.centre, plane) && same_oval(ball.oval, one.oval, plane);
          }) == 1);
  // Three cells along v; its head is 11 long, and follows on the last piece.
  const Vec& v = flights[2].query.v;
  const double cell = std::cbrt(cell_volume(scene.lattices[0], 3));
  const Spot tip = seen(sum(flights[2].query.x, scaled(v, 3 * cell / length(v))));
  int tips = 0;
  for (const Ink& head : picture.all("polygon", "fill", kFlight))
    tips += same_place(head.points[0], tip, plane);
  CHECK(tips == 1);
  CHECK(picture.says("never hits"));
  CHECK(picture.says("flight to its first hit"));
  CHECK_FALSE(picture.says("inside"));
}

TEST_CASE("3D: a layer's faces and a cylinder are where they are, as wide as they are",
          "[pictures][scene_drawing]") {
  // The simple cubic lattice: the planes y = 1/2 -+ 0.3 across the block of 2 x 2 x 2, and a cylinder along
  // z.
  DrawOptions options;
  options.title = "Ways";
  options.ways = {{FreeWay::Kind::layer, {0, -3.5, 0}, {0, GENERATE(1.0, -1.0), 0}, 0.6, "layer"},
                  {FreeWay::Kind::cylinder, {-3.5, 7.5, 1.25}, {0, 0, 1}, 0.4, "cylinder"}};
  const SvgPicture picture(draw_scene(unit_scene(3, 0.2), options, {}).svg);
  CHECK(picture.beyond_page() == "");
  const auto wanted = in_block(obstacles_of(unit_scene(3, 0.2), 3, {"atom 0: radius 0.2"}, kRight, kUp),
                               unit_scene(3, 1).lattices[0].vectors, {}, 2);
  const Plane plane = fitted(balls_of(picture), wanted);
  check_drawn(picture, balls_of(picture), plane, wanted);
  const Inks faces = picture.all("polygon", "fill-opacity", "0.28");
  REQUIRE(faces.size() == 2);
  // Nearest to the block's middle, y = 1, of y = 1/2 and 3/2: either.
  double middle = 0.5;
  for (const Ink& face : faces)
    for (const Spot point : face.points)
      if (same_place(point, seen({0, 1.2, 0}), plane)) middle = 1.5;
  for (const double side : {-0.3, 0.3})
    for (const Vec& corner : {Vec{0, 0, 0}, Vec{2, 0, 0}, Vec{0, 0, 2}, Vec{2, 0, 2}}) {
      std::size_t times = 0;
      for (const Ink& face : faces)
        for (const Spot point : face.points)
          times += same_place(point, seen({corner[0], middle + side, corner[2]}), plane);
      CHECK(times >= 1);
    }
  // The farther face first; and whatever is nearer to the eye (on the side of -y) after it.
  std::vector<std::pair<std::string, double>> order;
  for (const Ink& ink : picture.inks) {
    if (ink.is("fill-opacity", "0.28") && ink.kind == "polygon") {
      for (const double side : {-0.3, 0.3})
        for (const Spot point : ink.points)
          if (same_place(point, seen({0, middle + side, 0}), plane)) order.push_back({"face", middle + side});
    }
    for (const Wanted& one : wanted)
      if (ink["fill"].find("url(") == 0 && same_place(ink.centre, one.centre, plane))
        order.push_back({"ball", one.place[1]});
  }
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k)
      if (order[i].first != order[k].first) CHECK(order[i].second > order[k].second);
  CHECK(faces[0]["fill"] == picture.mark_of("layer")["fill"]);
  CHECK(picture.mark_of("layer")["fill"] != picture.mark_of("cylinder")["fill"]);
  // The cylinder: as wide as it is, in pieces from 15 % below to 15 % above the block.
  const Inks pieces = picture.all("line", "stroke", picture.mark_of("cylinder")["fill"]);
  REQUIRE_FALSE(pieces.empty());
  double covered = 0;
  Vec foot{};
  for (const double x : {0.5, 1.5})
    for (const double y : {0.5, 1.5})
      if (same_place(pieces.front().points[0], seen({x, y, -0.3}), plane)) foot = {x, y, -0.3};
  CHECK(foot != Vec{});
  CHECK(same_place(pieces.back().points.back(), seen(sum(foot, {0, 0, 2.6})), plane));
  for (const Ink& piece : pieces) {
    CHECK(piece.number("stroke-width") == Approx(0.4 * plane.scale).epsilon(1e-3));
    covered += distance(piece.points[0], piece.points[1]) / plane.scale;
  }
  CHECK(covered == Approx(2.6 * kUp[2]).epsilon(1e-3));
}

TEST_CASE("A path: obstacles, both paths, where they part, and what is written of them",
          "[pictures][path_drawing]") {
  PathDrawing drawing{crowd(), 3, {{0.5, 0}, {1.5, 0.5}, {0.7, 1.9}, {-0.4, 1}}, {}, 0, "", 700};
  drawing.other = {{0.5, 0}, {1.5, 0.5}, {-1, 1.2}, {-1.5, -0.4}};
  drawing.parting = 2;
  drawing.other_name = "reduction";
  const SvgPicture picture(draw_path(drawing));
  CHECK(picture.beyond_page() == "");
  const Ink note = picture.text("the certified path, from the ring on: 3 collisions"),
            other = picture.text("reduction: another obstacle at collision 2");
  const Inks lines = picture.all("line");
  REQUIRE(lines.size() == 2);
  const Inks path = picture.all("line", "stroke", note["fill"]),
             parted = picture.all("line", "stroke", other["fill"]);
  REQUIRE(path.size() == 1);
  REQUIRE(parted.size() == 1);
  CHECK(path[0]["stroke-dasharray"].empty());
  CHECK_FALSE(parted[0]["stroke-dasharray"].empty());
  // The box of all places and 0.6 cells, across the page.
  const double more = 0.6 * std::sqrt(0.96), scale = (700 - 48) / (3 + 2 * more);
  const Plane plane{{24 + scale * (1.5 + more), 24 + scale * (1.9 + more)}, scale};
  REQUIRE(path[0].points.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(same_place(path[0].points[i], spot(drawing.path[i]), plane));
  REQUIRE(parted[0].points.size() == 3);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(same_place(parted[0].points[i], spot(drawing.other[i + 1]), plane));
  const auto dot_at = [&](const std::string& fill, Spot place) {
    std::size_t times = 0;
    for (const Ink& ink : picture.all("ellipse", "fill", fill)) times += same_place(ink.centre, place, plane);
    return times;
  };
  CHECK(dot_at("white", {0.5, 0}) == 1);
  CHECK(dot_at(note["fill"], {-0.4, 1}) == 1);
  CHECK(dot_at(other["fill"], {-1.5, -0.4}) == 1);
  // Obstacles by the names under the mouse.
  const std::array<double, 4> window{-1.5 - more, -0.4 - more, 1.5 + more, 1.9 + more};
  const auto wanted = within(obstacles_of(crowd(), 8, kCrowd), window);
  const Inks drawn = picture.all(
      "ellipse", [](const Ink& ink) { return !ink.hint.empty() && ink.is("stroke-width", "0.7"); });
  CHECK(drawn.size() == wanted.size());
  std::map<std::string, std::set<std::string>> colours;
  for (const Wanted& one : wanted) {
    INFO(one.name << " at " << one.centre.x << ", " << one.centre.y);
    std::size_t times = 0;
    for (const Ink& ink : drawn) {
      if (ink.hint != one.name || !same_place(ink.centre, one.centre, plane) ||
          !same_oval(ink.oval, one.oval, plane))
        continue;
      ++times;
      colours[one.name].insert(ink["fill"] + ink["stroke"]);
    }
    CHECK(times == 1);
  }
  std::set<std::string> different;
  for (const auto& [name, its] : colours) {
    CHECK(its.size() == 1);
    different.insert(*its.begin());
  }
  CHECK(different.size() == 4);
  // A tall path fits, too; without another there is one line; too many obstacles are left out, and that is
  // said.
  drawing.path = {{0, 0}, {0.3, 60}};
  drawing.other.clear();
  const SvgPicture tall(draw_path(drawing));
  CHECK(tall.beyond_page() == "");
  CHECK(tall.all("line").size() == 1);
  CHECK(tall.page.height() < 900);
  CHECK_FALSE(tall.says("another"));
  CHECK_FALSE(tall.says("left out"));
  drawing.path[1] = {60, 60};
  const SvgPicture many(draw_path(drawing));
  CHECK(many.says("obstacles are left out: there are too many to be seen"));
  CHECK(many.all("ellipse").size() == 2);
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

TEST_CASE("Flights that start far away, together, the legend of flights in space",
          "[pictures][scene_drawing]") {
  const Flight far{{{1000.5, 0.5}, {1, 0}, {}}, Answer::never()};
  CHECK(draw_scene(unit_scene(2, 0.1), {}, {far, far}).remarks.empty());
  const Flight inside{{{0.05, 0, 0}, {1, 0, 0}, {}}, Answer::inside({0, 0, {}})},
      goes_on{{{0.5, 0.5, 0.5}, {1, 0, 0}, {}}, Answer::hit({0, 0, {}}, 1000)};
  Scene many = unit_scene(3, 0.1);
  for (int i = 1; i < 12; ++i)
    many.lattices[0].atoms.push_back({{i / 12.0, i / 12.0, 0.1 * (i % 3)}, 0.02, {}});
  const SvgPicture picture(draw_scene(many, {}, {inside, goes_on}).svg);
  CHECK(picture.says("starts inside"));
  CHECK(picture.says("goes on"));
  CHECK_FALSE(picture.says("first hit"));
  for (const Ink& ball : balls_of(picture)) CHECK(picture.shades.count(ball["fill"]) == 1);
}
