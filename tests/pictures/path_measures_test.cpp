// Pictures of paths, measured.
#include <fmt/format.h>

#include <set>

#include <lorentz/oracle.hpp>
#include "report/pictures/scene_drawing.hpp"
#include "tests/pictures/crowd.hpp"

using namespace lorentz;
using namespace lorentz::pictures;
using namespace lorentz::test;

TEST_CASE("A path: obstacles, both paths, where they part, and what is written of them",
          "[pictures][path_drawing]") {
  PathDrawing drawing{crowd(), 3, {{0.5, 0}, {1.5, 0.5}, {0.7, 1.9}, {-0.4, 1}}, {}, {}, 0, ""};
  drawing.other = {{0.5, 0}, {1.5, 0.5}, {-1, 1.2}, {-1.5, -0.4}};
  drawing.parting = 2;
  drawing.other_words = "reduction: another obstacle at collision 2";
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
  const double more = 0.6 * std::sqrt(0.96), scale = (800 - 48) / (3 + 2 * more);
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
