// Drawings of findings, measured: obstacles by the names under the mouse, flights by their numbers.
#include <fmt/format.h>

#include <regex>

#include <lorentz/oracle.hpp>
#include "report/pictures/finding_drawing.hpp"
#include "tests/pictures/measures.hpp"

using namespace lorentz;
using namespace lorentz::pictures;
using namespace lorentz::test;

namespace {

const std::string kExact = "#0072b2", kGiven = "#d55e00", kInk = "#222222", kFaint = "#8c8c8c";

// "lattice 1, atom 0, cell (2, -1): .."
std::optional<ObstacleId> named(const std::string& hint) {
  static const std::regex kName(R"(^(?:lattice (\d+), )?(?:atom (\d+), )?cell \(([^)]*)\))");
  std::smatch m;
  if (!std::regex_search(hint, m, kName)) return std::nullopt;
  ObstacleId id;
  id.lattice = m[1].length() ? std::stoi(m[1]) : 0;
  id.atom = m[2].length() ? std::stoi(m[2]) : 0;
  long long n[3] = {0, 0, 0};
  std::sscanf(m[3].str().c_str(), "%lld, %lld, %lld", n, n + 1, n + 2);
  id.cell = {n[0], n[1], n[2]};
  return id;
}

double number_after(const std::string& text, const std::string& words) {
  const auto at = text.find(words);
  return at == std::string::npos ? NAN : std::strtod(text.c_str() + at + words.size(), nullptr);
}

// An obstacle and a line, in the coordinates in which it is the unit ball; lengths along the line are the
// scene's.
struct Meeting {
  double gap, start_gap, entry, nearest, per_length;

  Meeting(const Scene& scene, const Query& query, const ObstacleId& id) {
    const Atom& atom = scene.lattices[id.lattice].atoms[id.atom];
    const auto rows = dual_of(semiaxes_of(atom, scene.dimension), scene.dimension);
    const Vec arm = sum(query.x, scaled(centre_of(scene, id), -1)),
              along = scaled(query.v, 1 / length(query.v));
    Vec w{}, d{};
    for (int i = 0; i < scene.dimension; ++i) w[i] = dot(rows[i], arm), d[i] = dot(rows[i], along);
    per_length = length(d);
    nearest = -dot(w, d) / dot(d, d);
    const double least = length(sum(w, scaled(d, nearest)));
    gap = least - 1;
    start_gap = length(w) - 1;
    entry = least < 1 ? nearest - std::sqrt(1 - least * least) / per_length : nearest;
  }
};

struct Sheet {
  SvgPicture picture;
  Inks panel;  // what is drawn in the panel of the flight
  Plane plane;
  Scene scene;
  Query query;
  Vec along, across, depth;

  Sheet(const Scene& its_scene, const Query& its_query, const Answer& given, const Answer& exact,
        const Vec& beside)
      : picture(finding_drawing(its_scene, its_query, given, exact)),
        scene(its_scene),
        query(its_query),
        along(scaled(its_query.v, 1 / length(its_query.v))),
        across(beside),
        depth(cross(along, beside)) {
    CHECK(picture.beyond_page() == "");
    const Ink start = by_hint("the start"), end = by_hint("exact: ");
    CHECK(start["fill"] == "#ffffff");
    CHECK(end["fill"] == kExact);
    const double way = number_after(end.hint, "exact: ");
    CHECK(way == Approx(*exact.time * length(query.v)).epsilon(1e-8));
    plane = {start.centre, (end.centre.x - start.centre.x) / way};
    CHECK(end.centre.y == Approx(start.centre.y).margin(0.02));
    if (scene.dimension == 2) refine();
    CHECK(same_place(end.centre, {way, 0}, plane));
  }

  Ink by_hint(const std::string& words) const {
    for (const Ink& ink : picture.inks)
      if (ink.hint.find(words) == 0 && (words == "the start" || ink.hint.find("of length from") < 60))
        return ink;
    throw std::runtime_error("no " + words);
  }
  // The scale by the obstacle that is drawn farthest along the flight, for the flight may be short.
  void refine() {
    double farthest = 0;
    for (const Ink& ink : obstacles({{12, 80}, {628, 244}}))
      if (const double at = seen(centre_of(scene, *named(ink.hint))).x; std::fabs(at) > std::fabs(farthest)) {
        farthest = at;
        plane.scale = (ink.centre.x - plane.origin.x) / at;
      }
  }
  Spot seen(const Vec& place) const {
    const Vec arm = sum(place, scaled(query.x, -1));
    return {dot(along, arm), dot(across, arm)};
  }
  // Ellipses of named obstacles in a panel.
  Inks obstacles(const Rectangle& where) const {
    return picture.all("ellipse", [&](const Ink& ink) {
      return ink.clip && where.holds(ink.clip->low, 0.02) && where.holds(ink.clip->high, 0.02) &&
             named(ink.hint);
    });
  }
};

// A scale bar's pixels per radius, by its own words.
double pixels_per_radius(const SvgPicture& picture) {
  const Inks bars = picture.all(
      "line", [](const Ink& ink) { return ink.points.size() == 4 && ink.is("stroke-width", "1.5"); });
  REQUIRE(bars.size() == 1);
  const Spot a = bars[0].points[1], b = bars[0].points[2];
  CHECK(a.y == b.y);
  CHECK(bars[0].points[0].x == a.x);
  CHECK(bars[0].points[3].x == b.x);
  CHECK(b.x - a.x < 91);
  CHECK(b.x - a.x > 35);
  for (const Ink& text : picture.all("text"))
    if (distance(text.centre, {a.x, a.y - 8}) < 0.02) {
      const double bar = std::stod(text.words);
      CHECK(text.words == fmt::format("{:g} {}", bar, bar == 1 ? "radius" : "radii"));
      return (b.x - a.x) / bar;
    }
  throw std::runtime_error("no scale");
}

struct Measured {
  Spot from, to;
  double radii;
};

// The dots of the inset, and the number beside them: as far apart as it says by the scale bar.
Measured measured(const SvgPicture& picture) {
  const Inks dots =
      picture.all("ellipse", [](const Ink& ink) { return std::fabs(ink.radius() - 2.2) < 1e-9; });
  REQUIRE(dots.size() == 2);
  const Inks labels = picture.all("text", [](const Ink& ink) {
    return ink.is("font-weight", "bold") && ink.is("paint-order", "stroke");
  });
  REQUIRE(labels.size() == 1);
  const double radii = std::stod(labels[0].words);
  CHECK(distance(dots[0].centre, dots[1].centre) == Approx(radii * pixels_per_radius(picture)).epsilon(2e-3));
  return {dots[0].centre, dots[1].centre, radii};
}

const Rectangle kFlightPanel{{12, 80}, {628, 244}}, kInset{{316, 266}, {628, 400}},
    kSide{{196, 284}, {308, 400}};

Scene ellipses() {
  Scene scene = unit_scene(2, 0.2);
  scene.lattices[0].vectors = {Vec{1.1, 0.2, 0}, Vec{-0.3, 0.9, 0}, Vec{}};
  scene.lattices[0].atoms = {{{0.1, 0.05, 0}, 0.12, {}},
                             {{0.55, 0.5, 0}, 0, {{0.2, 0.1, 0}, {-0.02, 0.07, 0}}}};
  scene.lattices.push_back({{Vec{1.04, 0.78, 0}, Vec{-0.78, 1.04, 0}, Vec{}},
                            {{{0.3, 0.4, 0}, 0, {{0.03, 0.15, 0}, {0.06, 0, 0}}}}});
  return scene;
}

// All that lies in the panel, by name.
void check_plane_panel(const Sheet& sheet) {
  const Inks drawn = sheet.obstacles(kFlightPanel);
  std::map<std::string, int> names;
  for (const Ink& ink : drawn) {
    const ObstacleId id = *named(ink.hint);
    INFO(ink.hint);
    ++names[fmt::format("{} {} {} {}", id.lattice, id.atom, id.cell[0].int64(), id.cell[1].int64())];
    CHECK(same_place(ink.centre, sheet.seen(centre_of(sheet.scene, id)), sheet.plane));
    const Atom& atom = sheet.scene.lattices[id.lattice].atoms[id.atom];
    CHECK(same_oval(ink.oval, shadow(atom, 2, sheet.along, sheet.across), sheet.plane));
  }
  std::size_t missing = 0, inside = 0;
  for (int l = 0; l < static_cast<int>(sheet.scene.lattices.size()); ++l)
    for (int a = 0; a < static_cast<int>(sheet.scene.lattices[l].atoms.size()); ++a)
      for (std::int64_t i = -25; i <= 25; ++i)
        for (std::int64_t k = -25; k <= 25; ++k) {
          const Spot at = sheet.seen(centre_of(sheet.scene, {l, a, {i, k}}));
          const Spot paper{sheet.plane.origin.x + sheet.plane.scale * at.x,
                           sheet.plane.origin.y - sheet.plane.scale * at.y};
          if (!kFlightPanel.holds(paper)) continue;
          ++inside;
          missing += names[fmt::format("{} {} {} {}", l, a, i, k)] != 1;
        }
  CHECK(inside > 8);
  CHECK(missing == 0);
}

// The numbers under the mouse: of the obstacles that an answer names.
void check_hints(const Sheet& sheet) {
  std::size_t hints = 0;
  for (const Ink& ink : sheet.picture.all("ellipse")) {
    if (ink.hint.find("of its radii, ") == std::string::npos) continue;
    ++hints;
    INFO(ink.hint);
    const Meeting is(sheet.scene, sheet.query, *named(ink.hint));
    CHECK(number_after(ink.hint, is.gap < 0 ? "meets it by " : "misses it by ") ==
          Approx(std::fabs(is.gap)).epsilon(1e-5));
    CHECK(number_after(ink.hint, "radii, ") == Approx(is.entry).epsilon(1e-8));
    CHECK(number_after(ink.hint, is.start_gap < 0 ? "inside it by " : "outside of it by ") ==
          Approx(std::fabs(is.start_gap)).epsilon(1e-5));
  }
  CHECK(hints >= 2);
}

void check_compass(const Sheet& sheet) {
  const Inks heads = sheet.picture.all("polygon", "fill", "currentColor");
  std::size_t arrows = 0;
  for (int k = 0; k < sheet.scene.dimension; ++k) {
    const double x = sheet.along[k], y = sheet.across[k];
    if (std::hypot(x, y) < 0.25) continue;
    REQUIRE(arrows < heads.size());
    const Spot tip = heads[arrows++].points[0];
    CHECK(distance(tip, {34 + 16 * x, 100 - 16 * y}) < 0.03);
    CHECK(distance(sheet.picture.text(std::string(1, "xyz"[k])).centre, {34 + 24 * x - 3, 100 - 24 * y + 3}) <
          0.03);
  }
  CHECK(arrows == heads.size());
}

}  // namespace

TEST_CASE("A finding in the plane: what stands beside the flight, both its ends, and the inset's place",
          "[pictures][finding_drawing]") {
  const Scene scene = ellipses();
  // Upwards to the left, and to the right; both with a speed.
  const Query query =
      GENERATE(Query{{0.9, -0.5, 0}, {-1.5, 2.3, 0}, {}}, Query{{0.3, 0.85, 0}, {2, -0.35, 0}, {}});
  const Answer exact = oracle::Oracle(scene).first_hit(query);
  REQUIRE(exact.outcome == Outcome::hit);
  const Vec along = scaled(query.v, 1 / length(query.v)), across{-along[1], along[0], 0};
  // Who passed over it, and found a later one on the line or beside it.
  ObstacleId later;
  double best = 1e9;
  for (int l = 0; l < 2; ++l)
    for (std::int64_t i = -6; i <= 6; ++i)
      for (std::int64_t k = -6; k <= 6; ++k) {
        const ObstacleId id{l, 0, {i, k}};
        const Meeting meeting(scene, query, id);
        if (meeting.gap < 0 && meeting.entry > *exact.time * length(query.v) + 1e-9 && meeting.entry < best)
          best = meeting.entry, later = id;
      }
  const Answer given = Answer::hit(later, best / length(query.v));
  const Sheet sheet(scene, query, given, exact, across);
  const SvgPicture& picture = sheet.picture;
  check_plane_panel(sheet);
  check_hints(sheet);
  check_compass(sheet);
  for (const Ink& text : picture.all("text"))
    for (const auto& [who, colour] : {std::pair{"exact: ", kExact}, {"given: ", kGiven}})
      if (text.words.find(who) == 0) CHECK(text["fill"] == colour);
  // The colours of what the answers name, and of their lines; the words beside these.
  for (const Ink& ink : sheet.obstacles(kFlightPanel)) {
    const ObstacleId id = *named(ink.hint);
    CHECK(ink["fill"] == (id == exact.obstacle ? kExact : id == later ? kGiven : kFaint));
  }
  const Spot entry{number_after(sheet.by_hint("exact: ").hint, "exact: "), 0}, found{best, 0};
  int exact_lines = 0, given_lines = 0;
  for (const Ink& line : picture.all("line")) {
    if (!line.clip || !kFlightPanel.holds(line.points[0], 0.02)) continue;
    exact_lines += line.is("stroke", kExact) && same_place(line.points[0], {0, 0}, sheet.plane) &&
                   same_place(line.points[1], entry, sheet.plane) && line["stroke-dasharray"].empty();
    given_lines += line.is("stroke", kGiven) && same_place(line.points[0], {0, 0}, sheet.plane) &&
                   same_place(line.points[1], found, sheet.plane) && !line["stroke-dasharray"].empty();
  }
  CHECK(exact_lines == 1);
  CHECK(given_lines == 1);
  CHECK(number_after(sheet.by_hint("given: ").hint, "given: ") == Approx(best).epsilon(1e-7));
  Inks cross = picture.all(
      "line", [](const Ink& ink) { return ink.hint.find("given: ") == 0 && ink.is("stroke-width", "2"); });
  REQUIRE(cross.size() == 2);
  for (const Ink& line : cross) {
    const Spot centre{(line.points[0].x + line.points[1].x) / 2, (line.points[0].y + line.points[1].y) / 2};
    CHECK(same_place(centre, found, sheet.plane));
    CHECK(line["stroke"] == kGiven);
  }
  // What the inset is about: an order, or the line; a square is around that place, and lines lead to it.
  const Inks squares = picture.all("polygon", [](const Ink& ink) {
    return ink.is("stroke-width", "1.2") && std::fabs(ink.points[2].x - ink.points[0].x - 12) < 0.02;
  });
  REQUIRE(squares.size() == 1);
  const auto& corners = squares[0].points;
  const Meeting first(scene, query, exact.obstacle);
  const bool order = picture.title.find("is entered") != std::string::npos;
  CHECK(same_place({corners[0].x + 6, corners[0].y + 6}, {order ? first.entry : first.nearest, 0},
                   sheet.plane));
  int leads = 0;
  for (const Ink& line : picture.all("line"))
    leads += (distance(line.points[0], corners[3]) < 0.02 && distance(line.points[1], kInset.low) < 0.02) ||
             (distance(line.points[0], corners[2]) < 0.02 &&
              distance(line.points[1], {kInset.high.x, kInset.low.y}) < 0.02);
  CHECK(leads == 2);
  // The inset's number and its magnification.
  const Measured inset = measured(picture);
  CHECK(inset.radii ==
        Approx(order ? (best - first.entry) * first.per_length : std::fabs(first.gap)).epsilon(1e-3));
  const Inks captions = picture.all("text", [](const Ink& ink) { return ink.words.find("magnified ") == 0; });
  REQUIRE(captions.size() == 1);
  const double times = pixels_per_radius(picture) * first.per_length / sheet.plane.scale;
  CHECK(number_after(captions[0].words, "magnified ") == Approx(times).epsilon(0.06));
  CHECK((captions[0].words.find("the ellipse is a disc") != std::string::npos) ==
        !scene.lattices[exact.obstacle.lattice].atoms[exact.obstacle.atom].is_ball());
}

TEST_CASE("An inset shows the surface as a circle, on the side on which it is",
          "[pictures][finding_drawing]") {
  // The line passes below or above an ellipse's centre by most of its size, in any direction.
  const double side = GENERATE(1, -1), degrees = GENERATE(15, 130, 250), share = GENERATE(0.9, 1.1);
  CAPTURE(side, degrees, share);
  Scene scene = unit_scene(2, 0.2);
  scene.lattices[0].atoms[0] = {{0.4, 0.5, 0}, 0, {{0.2, 0.1, 0}, {-0.02, 0.07, 0}}};
  const double turn = degrees * std::acos(-1) / 180;
  const Vec along{std::cos(turn), std::sin(turn), 0}, across{-along[1], along[0], 0};
  // So far from the centre a tangent runs: sqrt(across^T A A^T across).
  const double reach = std::sqrt(shadow(scene.lattices[0].atoms[0], 2, along, across).yy);
  const Vec middle = sum(scene.lattices[0].atoms[0].position, scaled(across, -side * share * reach));
  const Query query{sum(middle, scaled(along, -0.3)), scaled(along, 2), {}};
  const ObstacleId id{0, 0, {0, 0}};
  const Meeting meeting(scene, query, id);
  CHECK(meeting.gap == Approx(share - 1));
  // The other flight goes on for ever, or to an obstacle behind.
  Query beyond = query;
  beyond.from = id;
  const bool is_endless = GENERATE(true, false);
  const Answer met = Answer::hit(id, meeting.entry / 2),
               never = is_endless ? Answer::never() : oracle::Oracle(scene).first_hit(beyond);
  REQUIRE((is_endless || never.outcome == Outcome::hit));
  const SvgPicture picture(finding_drawing(scene, query, share < 1 ? never : met, share < 1 ? met : never));
  const Measured inset = measured(picture);
  CHECK(inset.radii == Approx(std::fabs(share - 1)).epsilon(1e-3));
  CHECK(inset.from.y + inset.to.y == Approx(2 * 333).margin(0.03));
  const double radius = pixels_per_radius(picture), gap = (share - 1) * radius;
  // From the line to the surface: upwards on paper if the obstacle is on that side and missed.
  CHECK(inset.to.y - inset.from.y == Approx(-side * gap).margin(0.03));
  const Inks surfaces = picture.all("polygon", "fill-opacity", "0.25");
  REQUIRE(surfaces.size() == 1);
  const Spot centre{inset.to.x, inset.to.y - side * radius};
  for (const Spot point : surfaces[0].points) CHECK(distance(point, centre) == Approx(radius).margin(0.03));
  // The flight that ends at the obstacle ends on that circle, the other goes through the inset.
  int ends = 0, through = 0;
  for (const Ink& line : picture.all("line")) {
    if (!line.clip || !kInset.holds(line.clip->low, 0.02) ||
        std::fabs(line.points[0].y - inset.from.y) > 0.02)
      continue;
    const bool is_met = line.is("stroke", share < 1 ? kExact : kGiven),
               is_never = line.is("stroke", share < 1 ? kGiven : kExact);
    if (is_met)
      ends += share > 1 ? std::fabs(line.points[1].x - inset.from.x) < 0.03
                        : std::fabs(distance(line.points[1], centre) - radius) < 0.03 &&
                              line.points[1].x < inset.from.x;
    if (is_never) through += line.points[0].x < kInset.low.x && line.points[1].x > kInset.high.x;
  }
  CHECK(through == 1);
  const double chord =
      inset.from.x - std::sqrt(std::max(0.0, radius * radius - (radius + gap) * (radius + gap)));
  CHECK(ends == (share > 1 || chord > kInset.low.x - 100 ? 1 : ends));
}

TEST_CASE("An inset shows the start and the surface nearest to it", "[pictures][finding_drawing]") {
  const double degrees = GENERATE(25, 160, 300), share = GENERATE(0.9, 1.05);
  Scene scene = unit_scene(2, 0.2);
  scene.lattices[0].atoms.push_back({{0.5, 0.5, 0}, 0.1, {}});
  const double turn = degrees * std::acos(-1) / 180;
  // x beside the second atom of cell (1, 0), on the side of `turn`; v to the upper right.
  const ObstacleId id{0, 1, {1, 0}};
  const Vec away{std::cos(turn), std::sin(turn), 0}, v{1, 0.5, 0};
  const Query query{sum(centre_of(scene, id), scaled(away, 0.1 * share)), v, {}};
  const Answer exact = oracle::Oracle(scene).first_hit(query);
  const Answer given = share < 1 ? Answer::never() : Answer::inside(id);
  const SvgPicture picture(finding_drawing(scene, query, given, exact));
  const Measured inset = measured(picture);
  CHECK(inset.radii == Approx(std::fabs(share - 1)).epsilon(1e-3));
  CHECK(inset.from.x + inset.to.x == Approx(2 * 472).margin(0.03));
  CHECK(inset.from.y + inset.to.y == Approx(2 * 333).margin(0.03));
  const double radius = pixels_per_radius(picture);
  // The start is the first; the circle's middle lies against `away`, as the drawing turns it.
  const Inks starts = picture.all(
      "ellipse", [&](const Ink& ink) { return ink.hint == "the start" && kInset.holds(ink.centre); });
  REQUIRE(starts.size() == 1);
  CHECK(distance(starts[0].centre, inset.from) < 0.02);
  const Vec along = scaled(v, 1 / length(v)), across{-along[1], along[0], 0};
  const Spot centre{inset.from.x - share * radius * dot(away, along),
                    inset.from.y + share * radius * dot(away, across)};
  const Inks surfaces = picture.all("polygon", "fill-opacity", "0.25");
  REQUIRE(surfaces.size() == 1);
  for (const Spot point : surfaces[0].points) CHECK(distance(point, centre) == Approx(radius).margin(0.05));
  CHECK(distance(inset.to, centre) == Approx(radius).margin(0.05));
  CHECK(surfaces[0]["fill"] == (share < 1 || exact.obstacle == id ? kExact : kGiven));
}

TEST_CASE("An inset of the start shows both flights", "[pictures][finding_drawing]") {
  const Scene scene = unit_scene(2, 0.25);
  const Query query{{0.3, 0, 0}, {1, 0.5, 0}, {}};
  const Answer exact = oracle::Oracle(scene).first_hit(query);
  const SvgPicture picture(finding_drawing(scene, query, Answer::hit({}, 1), exact));  // behind the start
  for (const std::string& ink : {kExact, kGiven}) {
    int lines = 0;
    for (const Ink& line : picture.all("line", "stroke", ink))
      lines += line.clip && kInset.holds(line.clip->low, 0.02);
    CHECK(lines == 1);
  }
}

TEST_CASE("An inset shows two entries: which is first, and whose surface is whose",
          "[pictures][finding_drawing]") {
  const bool wrong_order = GENERATE(true, false);
  Scene scene = unit_scene(2, 0.25);
  scene.lattices[0].atoms.push_back({{-0.2, 0.05, 0}, 0.2, {}});
  const Query query{{-0.6, 0.07, 0}, {3, 0, 0}, {}};
  const Answer exact = oracle::Oracle(scene).first_hit(query);
  const ObstacleId other{0, 1 - exact.obstacle.atom, {0, 0}};
  const Meeting first(scene, query, exact.obstacle), second(scene, query, other);
  // Another disc, or a time that is late.
  const double late = wrong_order ? second.entry : first.entry + 0.1;
  const Answer given = Answer::hit(wrong_order ? other : exact.obstacle, late / 3);
  const SvgPicture picture(finding_drawing(scene, query, given, exact));
  const Measured inset = measured(picture);
  CHECK(inset.radii == Approx((late - first.entry) * first.per_length).epsilon(1e-3));
  CHECK(inset.from.y == inset.to.y);
  CHECK(inset.from.x < inset.to.x);
  const double scale = pixels_per_radius(picture) * first.per_length;  // per length
  const Inks surfaces = picture.all("polygon", "fill-opacity", "0.25");
  REQUIRE(surfaces.size() == (wrong_order ? 2 : 1));
  for (const Ink& surface : surfaces) {
    const bool is_first = surface.is("fill", kExact);
    const ObstacleId& id = is_first ? exact.obstacle : other;
    CHECK(named(surface.hint) == id);
    const Vec centre = centre_of(scene, id);
    const Spot middle{inset.from.x + (centre[0] + 0.6 - first.entry) * scale,
                      inset.from.y - (centre[1] - 0.07) * scale};
    for (const Spot point : surface.points)
      CHECK(distance(point, middle) == Approx(scene.lattices[0].atoms[id.atom].radius * scale).margin(0.05));
  }
  CHECK(surfaces[0]["fill"] == kExact);
  int exact_ends = 0, given_ends = 0;
  for (const Ink& line : picture.all("line")) {
    if (!line.clip || !kInset.holds(line.clip->low, 0.02) || line.points[0].x > kInset.low.x) continue;
    exact_ends += line.is("stroke", kExact) && distance(line.points[1], inset.from) < 0.02;
    given_ends += line.is("stroke", kGiven) && distance(line.points[1], inset.to) < 0.02;
  }
  CHECK(exact_ends == 1);
  CHECK(given_ends == 1);
}

TEST_CASE("A finding in space: sections by the plane of the drawing, shadows, and the view along the flight",
          "[pictures][finding_drawing]") {
  Scene scene = unit_scene(3, 0.2);
  scene.lattices[0].atoms[0] = {{0.1, 0, 0}, 0, {{0.2, 0.1, 0}, {-0.02, 0.07, 0.05}, {0, 0.03, 0.25}}};
  scene.lattices[0].atoms.push_back({{0.5, 0.4, 0.55}, 0.17, {}});
  const Query query{{0.45, 0.1, 0.05}, {1.2, 0.3, 0.4}, {}};
  const Answer exact = oracle::Oracle(scene).first_hit(query);
  REQUIRE(exact.outcome == Outcome::hit);
  const Vec along = scaled(query.v, 1 / length(query.v)),
            arm = sum(centre_of(scene, exact.obstacle), scaled(query.x, -1));
  const Vec rest = sum(arm, scaled(along, -dot(arm, along))), across = scaled(rest, 1 / length(rest));
  // The question is whether the line meets it: nothing was found.
  const Sheet sheet(scene, query, Answer::never(), exact, across);
  check_hints(sheet);
  check_compass(sheet);
  int sections = 0, shadows = 0;
  for (const Ink& ink : sheet.obstacles(kFlightPanel)) {
    INFO(ink.hint);
    const ObstacleId id = *named(ink.hint);
    const Atom& atom = scene.lattices[0].atoms[id.atom];
    const Vec centre = centre_of(scene, id);
    const double before = dot(sheet.depth, sum(centre, scaled(query.x, -1)));
    if (!ink["stroke-dasharray"].empty()) {  // a shadow
      ++shadows;
      CHECK(same_place(ink.centre, sheet.seen(centre), sheet.plane));
      CHECK(same_oval(ink.oval, shadow(atom, 3, along, across), sheet.plane));
      if (id != exact.obstacle) CHECK((ink.hint.find("in front") != std::string::npos) == (before > 0));
      CHECK(std::fabs(before) < 0.5);
      continue;
    }
    ++sections;
    // Points of the ellipse are points of the ellipsoid's surface.
    const Spot middle = sheet.plane(ink.centre);
    const Oval oval = sheet.plane(ink.oval);
    const double l11 = std::sqrt(oval.xx), l21 = oval.xy / l11, l22 = std::sqrt(oval.yy - l21 * l21);
    const auto rows = dual_of(semiaxes_of(atom, 3), 3);
    for (int k = 0; k < 8; ++k) {
      const double c = std::cos(k * 0.8), s = std::sin(k * 0.8);
      const Vec place =
          sum(query.x, sum(scaled(along, middle.x + l11 * c), scaled(across, middle.y + l21 * c + l22 * s)));
      Vec y{};
      for (int i = 0; i < 3; ++i) y[i] = dot(rows[i], sum(place, scaled(centre, -1)));
      CHECK(length(y) == Approx(1).margin(5e-3));
    }
  }
  CHECK(sections > 3);
  CHECK(shadows > 1);
  CHECK(sheet.picture.says("Above: the plane"));
  // Along the flight: the obstacle is above it, as far as the line passes from its centre.
  const Inks beside = sheet.obstacles(kSide);
  REQUIRE(beside.size() == 1);
  const Spot middle{(kSide.low.x + kSide.high.x) / 2, (kSide.low.y + kSide.high.y) / 2};
  CHECK(beside[0].centre.x == Approx(middle.x).margin(0.02));
  const Plane view{middle, (middle.y - beside[0].centre.y) / length(rest)};
  CHECK(view.scale > 0);
  CHECK(same_oval(beside[0].oval,
                  shadow(scene.lattices[0].atoms[exact.obstacle.atom], 3, sheet.depth, across), view));
  // With another, named wrongly: it stands to the right where it is in front.
  const ObstacleId other{0, 1, {1, 0, -1}};
  const SvgPicture both(finding_drawing(scene, query, Answer::hit(other, 1), exact, exact.obstacle));
  for (const Ink& ink : both.all("ellipse")) {
    if (!ink.clip || distance(ink.clip->low, kSide.low) > 0.02 || named(ink.hint) != other) continue;
    const Vec to = sum(centre_of(scene, other), scaled(query.x, -1));
    CHECK((ink.centre.x > middle.x) == (dot(to, sheet.depth) > 0));
    CHECK((ink.centre.y < middle.y) == (dot(to, across) > 0));
    CHECK((ink.centre.x - middle.x) / (middle.y - ink.centre.y) ==
          Approx(dot(to, sheet.depth) / dot(to, across)).epsilon(1e-2));
  }
}

TEST_CASE("A long flight is broken: what is left out is counted, both ends are to scale",
          "[pictures][finding_drawing]") {
  // 120 cells to the right, past discs that are missed by 0.05.
  Scene scene = unit_scene(2, 0.2);
  const Query query{{0.5, 0.25, 0}, {2, 0, 0}, {}};
  scene.lattices.push_back({{Vec{400, 0, 0}, Vec{0, 400, 0}, Vec{}}, {{{120.5, 0.5, 0}, 0.3, {}}}});
  const Answer exact = oracle::Oracle(scene).first_hit(query);
  REQUIRE(exact.obstacle.lattice == 1);
  const SvgPicture picture(finding_drawing(scene, query, Answer::never(), exact));
  CHECK(picture.beyond_page() == "");
  // Each stretch by what stands in it: where it begins and ends along the line.
  std::map<double, std::pair<double, double>> stretches;  // by its left edge
  double scale = 0;
  for (const Ink& a : picture.all("ellipse"))
    for (const Ink& b : picture.all("ellipse")) {
      const auto p = named(a.hint), q = named(b.hint);
      if (!a.clip || !b.clip || !p || !q || p->lattice || q->lattice ||
          !kFlightPanel.holds(a.clip->low, 0.02) || distance(a.clip->low, b.clip->low) > 0.01)
        continue;
      const double xa = static_cast<double>(p->cell[0].int64()), xb = static_cast<double>(q->cell[0].int64());
      if (xb <= xa) continue;
      const double its = (b.centre.x - a.centre.x) / (xb - xa);
      if (scale == 0) scale = its;
      CHECK(its == Approx(scale).epsilon(1e-3));
      CHECK(a.radius() == Approx(0.2 * scale).epsilon(1e-3));
      stretches[a.clip->low.x] = {xa + (a.clip->low.x - a.centre.x) / scale,
                                  xa + (a.clip->high.x - a.centre.x) / scale};
    }
  REQUIRE(stretches.size() == 2);
  const double left_out = stretches.rbegin()->second.first - stretches.begin()->second.second;
  const Inks counts =
      picture.all("text", [](const Ink& ink) { return ink.words.find(" cells") != std::string::npos; });
  REQUIRE(counts.size() == 1);
  CHECK(std::stod(counts[0].words) == Approx(left_out).epsilon(5e-3));
  int zigzags = 0;
  for (const Ink& line : picture.all("line"))
    if (line.hint.find("cells of the flight are left out") != std::string::npos) {
      ++zigzags;
      CHECK(std::stod(line.hint) == Approx(left_out).epsilon(1e-3));
    }
  CHECK(zigzags == 2);
  // The flight of both answers begins at the start, and runs on in the second stretch.
  const double edge = stretches.rbegin()->first, from = stretches.rbegin()->second.first;
  const double end = edge + (0.5 + 2 * *exact.time - from) * scale;
  int ends = 0, goes_on = 0;
  for (const Ink& line : picture.all("line")) {
    if (!line.clip || std::fabs(line.clip->low.x - edge) > 0.01) continue;
    ends += line.is("stroke", kExact) && std::fabs(line.points[0].x - edge) < 0.03 &&
            std::fabs(line.points[1].x - end) < 0.05;
    goes_on += line.is("stroke", kGiven) && std::fabs(line.points[1].x - line.clip->high.x) < 0.03;
  }
  CHECK(ends == 1);
  CHECK(goes_on == 1);
  const Inks tips =
      picture.all("polygon", [](const Ink& ink) { return ink.is("fill", kGiven) && ink.points.size() == 3; });
  REQUIRE(tips.size() == 1);
  CHECK(tips[0].points[0].x > tips[0].points[1].x);
  CHECK(std::fabs(tips[0].points[0].x - 628) < 0.03);
}
