// Pictures of scenes in space, measured: each obstacle, flight and channel is where it is, and as large as it
// is.
#include <fmt/format.h>

#include <set>

#include <lorentz/oracle.hpp>
#include "report/pictures/scene_drawing.hpp"
#include "tests/pictures/crowd.hpp"

using namespace lorentz;
using namespace lorentz::pictures;
using namespace lorentz::test;

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

// True if an obstacle is between the place and the eye, or around it; no value within `slack` of the edge.
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
  std::vector<pictures::DrawnFlight> flights;
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

TEST_CASE("Flights that start far away, together, the legend of flights in space",
          "[pictures][scene_drawing]") {
  const pictures::DrawnFlight far{{{1000.5, 0.5}, {1, 0}, {}}, Answer::never()};
  CHECK(draw_scene(unit_scene(2, 0.1), {}, {far, far}).remarks.empty());
  const pictures::DrawnFlight inside{{{0.05, 0, 0}, {1, 0, 0}, {}}, Answer::inside({0, 0, {}})},
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
