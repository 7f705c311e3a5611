// Margins and conditions whose values follow by hand, one for each kind of input and decision.
#include <catch2/catch.hpp>

#include <lorentz/margin.hpp>
#include <lorentz/oracle.hpp>
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using oracle::DecisionKind;
using oracle::Margins;

namespace {

constexpr double kUlp = 0x1p-52;  // of 1, the size of the cell

Answer truth(const Scene& scene, const Query& query) {
  return oracle::Oracle(scene).first_hit(query);
}

oracle::HardestDecision hardest(const Scene& scene, const Query& query) {
  return Margins(scene).hardest_decision(query, truth(scene, query)).value();
}

double condition(const Scene& scene, const Query& query) {
  return Margins(scene).condition(query, truth(scene, query));
}

// The margin of the decision to meet the obstacle that is hit; not limited.
double meeting(const Scene& scene, const Query& query) {
  const Answer exact = truth(scene, query);
  const auto passed = Margins(scene).passed(query, exact, 1);
  REQUIRE(passed.size() == 1);
  REQUIRE(passed[0].obstacle == exact.obstacle);
  return passed[0].margin;
}

Catch::Detail::Approx about(double value) {
  return Approx(value).epsilon(1e-9);
}

}  // namespace

TEST_CASE("Margins: of a flight at a disc's centre the radius over what moves across the flight",
          "[oracle][margin_value]") {
  // Only what is across counts: along the flight an ulp of x changes nothing.
  CHECK(meeting(unit_scene(2, 0.25), {{0.5, 0}, {1, 0}, {}}) == about(0.25 / (kUlp + kUlp / 4)));
  // In space any direction across.
  CHECK(meeting(unit_scene(3, 0.25), {{0.5, 0, 0}, {1, 0, 0}, {}}) ==
        about(0.25 / (std::sqrt(2) * kUlp + kUlp / 4)));
}

TEST_CASE("Margins: of a start at a disc's centre the radius over the longest that x moves",
          "[oracle][margin_value]") {
  for (const int d : {2, 3}) {
    const double radius = 0x1p-40;
    const auto decision = hardest(unit_scene(d, radius), {{1, 1, d == 3 ? 1.0 : 0.0}, {1, 0.5, 0}, {}});
    CHECK(decision.kind == DecisionKind::containing);
    CHECK(decision.yes);
    CHECK(decision.margin == about(radius / (std::sqrt(d) * kUlp + radius * kUlp)));
  }
}

TEST_CASE("Margins: a component of v counts with its time, one that is zero not at all",
          "[oracle][margin_value]") {
  // 4 ulps of x below the edge.
  const double b = 0.25 - 4 * kUlp;
  CHECK(hardest(unit_scene(2, 0.25), {{0.5, b}, {1, 0}, {}}).margin == about(4 / 1.25));
  // However slow, and so however late.
  CHECK(hardest(unit_scene(2, 0.25), {{0.5, b}, {1e-310, 0}, {}}).margin == about(4 / 1.25));
  // v_2 = 2^-60 moves by 2^-112, which is nothing at T = 1/2.
  CHECK(hardest(unit_scene(2, 0.25), {{0.5, b}, {1, 0x1p-60}, {}}).margin == about((4 - 0x1p-9) / 1.25));
  // v = (1, 1): the distance of (1, 1) from the line x_2 = x_1 + c is c / sqrt(2), changes of x_1, x_2 and of
  // v times T = 1 - c/2 count 1 / sqrt(2) each.
  const double c = 0x1p-40, radius = c / std::sqrt(2) * (1 + 0x1p-10);
  const double change = std::sqrt(2) * (kUlp + (1 - c / 2) * kUlp);
  CHECK(hardest(unit_scene(2, radius), {{0, c}, {1, 1}, ObstacleId{}}).margin ==
        Approx((radius - c / std::sqrt(2)) / change).epsilon(1e-5));
}

TEST_CASE("Margins: the ulp of x is that of the cell, or its own where that is more",
          "[oracle][margin_value]") {
  const double far = 0x1p10;
  // 2^10 cells away x_2 moves by 2^-42.
  CHECK(hardest(unit_scene(2, 0.25), {{0.5, far + 0.25 - 0x1p-40}, {1, 0}, {}}).margin ==
        about(0x1p-40 / (0x1p-42 + 0x1p-54)));
  Scene large = unit_scene(2, 0.25);
  large.lattices[0].vectors = {Vec{1, 0, 0}, Vec{0, 64, 0}};
  CHECK(hardest(large, {{0.5, 0.25 - 0x1p-40}, {1, 0}, {}}).margin == about(0x1p-40 / (0x1p-46 + 0x1p-54)));
}

TEST_CASE("Margins: an obstacle just too far away is found though its radius moves more than x",
          "[oracle][margin_value]") {
  // (-7, 0) would be the smallest to contain 0, were the radius larger by 2^-30; its ulp is 2^-50.
  const auto decision = hardest(unit_scene(2, 7 - 0x1p-30), {{0, 0}, {1, 0.25}, {}});
  CHECK(decision.obstacle == ObstacleId{0, 0, {-7, 0, 0}});
  CHECK_FALSE(decision.yes);
  CHECK(decision.margin == about(0x1p-30 / (kUlp + 4 * kUlp)));
}

TEST_CASE("Margins: an ellipse counts in its own coordinates, its size by a factor",
          "[oracle][margin_value]") {
  // Semiaxes 1/2 and 1/8: at the height 1/8 - 2^-45 of the line, in units of 1/8: gap 2^-42 relative; x_2
  // moves by 2^-52 / (1/8), and the radius 1 by 2^-52.
  Scene scene = unit_scene(2, 1);
  scene.lattices[0].atoms[0] = {{0, 0, 0}, 0, {Vec{0.5, 0, 0}, Vec{0, 0.125, 0}}};
  CHECK(hardest(scene, {{-0.5, 0.125 - 0x1p-45}, {1, 0}, {ObstacleId{0, 0, {-1, 0, 0}}}}).margin ==
        about(0x1p-42 / (0x1p-49 + 0x1p-52)));
  scene.lattices[0].rank = 0, scene.lattices[0].vectors = {};
  const Query query{{-1, 0.125 - 0x1p-45}, {1, 0}, {}};
  const double margin = hardest(scene, query).margin;
  scene.lattices[0].atoms[0].radius = 1e6;  // an ellipse has none
  CHECK(hardest(scene, query).margin == margin);
}

TEST_CASE(
    "Margins: of two obstacles entered nearly together the difference of the times over that of the "
    "changes",
    "[oracle][margin_value]") {
  // Discs of radius r around (0, 0) and (e, h): flights along the middle between them. Both are met at 1/16
  // from their centres, on either side; the second one is e later.
  const double e = 0x1p-36, root = std::sqrt(15.0) / 16;
  Scene scene = unit_scene(2, 0.25);
  const Query query{{0.5, 0.0625}, {1, 0}, {}};
  // The radii of one atom move together, and change both times alike: cells (1, 0) and (1, 1) of a lattice
  // with u_2 = (e, 1/8).
  scene.lattices[0].vectors = {Vec{1, 0, 0}, Vec{e, 0.125, 0}};
  const Query leaving{query.x, query.v, ObstacleId{}};
  const auto same = hardest(scene, leaving);
  CHECK(same.kind == DecisionKind::order);
  // dt/dx_2 = -+ tan, tan = (1/16) / (sqrt(15)/16); x_1 moves both alike.
  CHECK(same.margin == about(e / (2 * (0.0625 / root) * kUlp)));
  // The radii of two atoms may not: dt/dr = -1 / cos each, cos = sqrt(15) / 4.
  scene = unit_scene(2, 0.25);
  scene.lattices[0].atoms.push_back({{e, 0.125, 0}, 0.25, {}});
  const double change = 2 * (0.0625 / root) * kUlp + 2 * (0.25 / root) * kUlp / 4;
  CHECK(hardest(scene, leaving).margin == about(e / change));
  // A tie is exactly 0.
  scene.lattices[0].atoms[1].position[0] = 0;
  CHECK(hardest(scene, leaving).margin == 0);
}

TEST_CASE("Conditions: what each input makes of the time", "[oracle][margin_value]") {
  // Head-on: dt = dx_1 / v_1 + t dv_1 / v_1 + dr / v_1, at v_1 = 3: t = 1/4 / 3 = 0.08333.
  const double t = 0.25 / 3, unit = 0x1p-56;
  CHECK(condition(unit_scene(2, 0.25), {{0.5, 0}, {3, 0}, {}}) ==
        about((kUlp / 3 + t * 2 * kUlp / 3 + kUlp / 4 / 3) / unit));
  // In space, aslant: the normal (-2, 1, 2) / 3 of a ball of radius 3/8 at (1, 0, 0), v = (1, 0, 0):
  // dt = dx_1 - dx_2 / 2 - dx_3 + t dv_1 + 3/2 dr.
  const double later = 0.5 - 0.25;
  CHECK(condition(unit_scene(3, 0.375), {{0.5, 0.125, 0.25}, {1, 0, 0}, {}}) ==
        about((2.5 * kUlp + later * kUlp + 1.5 * kUlp / 4) / (kUlp / 4)));
}

TEST_CASE("Obstacles that are passed are named once each, however far one looks for them",
          "[oracle][margin_value]") {
  const Scene scene = unit_scene(2, 0.25);
  const Query query{{0.5, 0.5}, {1, 0.125}, {}};  // past (1, 0), (1, 1), (2, 0) and (2, 1)
  const Answer exact = truth(scene, query);
  for (const std::size_t most : {2, 4, 100}) {
    const auto passed = Margins(scene).passed(query, exact, most);
    CHECK(passed.size() <= most);
    CHECK(passed.size() >= 2);
    for (std::size_t i = 0; i < passed.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(passed[i].obstacle == passed[j].obstacle);
  }
}
