// The one question of a ray and an obstacle: exact numbers, the exact sign, the time to 17 digits.
#include <catch2/catch.hpp>

#include <cmath>

#include "report/query_text.hpp"
#include "report/reason.hpp"
#include "tests/support/command_line.hpp"

using namespace lorentz;
using lorentz::test::contains;

namespace {

report::Primitive primitive(const Scene& scene, const Query& query, const ObstacleId& obstacle) {
  return report::primitive_of(oracle::Margins(scene), scene, query, obstacle);
}

}  // namespace

TEST_CASE("A line that touches a ball is said to miss it, by nothing", "[report][reason]") {
  const Scene square = unit_scene(2, 0.25);
  const Query along{{0.5, 0.25, 0}, {1, 0, 0}, {}};
  const auto dispute = report::dispute_of(oracle::Margins(square), square, along, Answer::never(),
                                          Answer::hit({0, 0, {1, 0, 0}}, 0.5), {});
  REQUIRE(dispute);
  CHECK(dispute->text == "the line misses lattice 0, atom 0, cell (1, 0) by 0 of its radii");
  const Query leaving{{0.5, 0.25, 0}, {1, 0, 0}, ObstacleId{0, 0, {1, 0, 0}}};
  const auto left = report::dispute_of(oracle::Margins(square), square, leaving, Answer::never(),
                                       Answer::hit({0, 0, {1, 0, 0}}, 0.5), {});
  CHECK(left->text == "lattice 0, atom 0, cell (1, 0) is the obstacle that the flight leaves");
  const Query within{{0.9, 0.125, 0}, {1, 0, 0}, ObstacleId{0, 0, {1, 0, 0}}};
  const Answer inside = Answer::inside({0, 0, {1, 0, 0}});
  CHECK(report::dispute_of(oracle::Margins(square), square, within, Answer::never(), inside, {})->text ==
        left->text);
  const auto words = [&](double y) {
    return primitive(square, {{0.5, y, 0}, {1, 0, 0}, {}}, {0, 0, {1, 0, 0}}).cpp;
  };
  CHECK(contains(words(0.25), "The exact discriminant is zero: the line touches it"));
  CHECK(contains(words(std::nextafter(0.25, 0)), "is positive: the line meets it"));
  CHECK(contains(words(std::nextafter(0.25, 1)), "is negative: the line misses it"));
}

TEST_CASE("What no obstacle decides has no reason", "[report][reason]") {
  const Scene square = unit_scene(2, 0.25);
  const Query along{{0.5, 0.5, 0}, {1, 0, 0}, {}};
  CHECK_FALSE(
      report::dispute_of(oracle::Margins(square), square, along, Answer::never(), Answer::undecided(), {}));
}

TEST_CASE("A scene has a radius if all its obstacles are balls of this radius", "[report][reason]") {
  Scene scene = unit_scene(2, 0.25);
  CHECK(report::name_with_radius("mine", scene) == "mine, r = 0.25");
  scene.lattices[0].atoms.push_back(scene.lattices[0].atoms[0]);
  CHECK(report::name_with_radius("mine", scene) == "mine, r = 0.25");
  scene.lattices[0].atoms[1].radius = 0.125;
  CHECK(report::name_with_radius("mine", scene) == "mine");
  scene.lattices[0].atoms.resize(1);
  scene.lattices[0].atoms[0].semiaxes = {Vec{0.25, 0, 0}, Vec{0, 0.125, 0}, Vec{}};
  CHECK(report::name_with_radius("mine", scene) == "mine");
}

TEST_CASE("The one question has the ball's exact centre, the sign of the discriminant, and the entry",
          "[report][primitive]") {
  const Scene square = unit_scene(2, 0.25);
  const auto met = primitive(square, {{0.5, 0, 0}, {3, 0, 0}, {}}, {0, 0, {1, 0, 0}});
  CHECK(met.json ==
        R"({"origin":["0x1p-1","0x0p+0"],"direction":["0x1.8p+1","0x0p+0"],"centre":["0x1p+0","0x0p+0"],)"
        R"("radius":"0x1p-2","discriminant":1,"entry_time":"0.083333333333333333"})");
  CHECK(met.cpp ==
        "const double x[] = {0x1p-1, 0x0p+0}, v[] = {0x1.8p+1, 0x0p+0};  // the ray x + t v\n"
        "const double c[] = {0x1p+0, 0x0p+0}, r = 0x1p-2;  // the ball\n"
        "// The exact discriminant is positive: the line meets it, and enters it at t = "
        "0.083333333333333333.\n");
  // The line touches, passes by an ulp, meets by an ulp: binary64's b^2 - 4 a c could not tell.
  const auto sign_at = [&](double y) {
    return oracle::Margins(square).crossing({{0.5, y, 0}, {1, 0, 0}, {}}, {0, 0, {-7, 0, 0}}).discriminant;
  };
  CHECK(sign_at(0.25) == 0);
  CHECK(sign_at(std::nextafter(0.25, 1)) == -1);
  CHECK(sign_at(std::nextafter(0.25, 0)) == 1);
  CHECK(contains(primitive(square, {{0.5, 0.25, 0}, {1, 0, 0}, {}}, {0, 0, {1, 0, 0}}).json,
                 R"("discriminant":0,"entry_time":null})"));
}

TEST_CASE("A centre that is not a binary64 is told exactly, and the snippet says that its own is rounded",
          "[report][primitive]") {
  Scene scene = unit_scene(2, 0.25);
  scene.lattices[0].atoms[0].position = {0x1p-60, 0, 0};
  const auto its = primitive(scene, {{0.5, 0, 0}, {1, 0, 0}, {}}, {0, 0, {-1, 3, 0}});
  CHECK(contains(its.json, R"("centre":["-0xfffffffffffffffp-60","0x3p+0"])"));
  CHECK(contains(its.cpp, "c[] = {-0x1p+0, 0x1.8p+1}"));
  CHECK(contains(its.cpp, "// c is rounded here; exactly it is {-0xfffffffffffffffp-60, 0x3p+0}\n"));
  CHECK_FALSE(contains(primitive(scene, {{0.5, 0, 0}, {1, 0, 0}, {}}, {0, 0, {}}).cpp, "rounded"));
}

TEST_CASE("An ellipsoid's one question has its semiaxes", "[report][primitive]") {
  Scene scene = unit_scene(3, 0.25);
  scene.lattices[0].atoms[0] = Atom{{}, 0, {{0.25, 0, 0}, {0, 0.125, 0}, {0, 0, 0.5}}};
  const auto its = primitive(scene, {{0.5, 0, 0}, {1, 0, 0}, {}}, {0, 0, {1, 0, 0}});
  CHECK(contains(its.json,
                 R"("semiaxes":[["0x1p-2","0x0p+0","0x0p+0"],["0x0p+0","0x1p-3","0x0p+0"],)"
                 R"(["0x0p+0","0x0p+0","0x1p-1"]],"discriminant":1,"entry_time":"0.25000000000000000"})"));
  CHECK(contains(its.cpp, "a[3][3] = {{0x1p-2, 0x0p+0, 0x0p+0}, "));
}

TEST_CASE("Ulps that tell nothing are not printed", "[report][primitive]") {
  CHECK(report::ulps_text(3.25) == "3.25 ulps");
  CHECK(report::ulps_text(0x1p20) == "2^20 ulps or more");
  CHECK(report::ulps_text(1e132) == "2^20 ulps or more");
}
