// What the search of the horizon does not do: it says so, and at once.
#include <lorentz/horizon.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include <lorentz/oracle.hpp>
#include "oracle/horizon/channel_scene.hpp"
#include "oracle/integers/dyadic.hpp"
#include "tests/oracle/horizon_support.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using namespace lorentz::oracle;

TEST_CASE("Horizon: what it leaves out is said, and nothing hangs", "[oracle][horizon]") {
  CHECK_THROWS_AS(horizon_of(unit_scene(2, 1e-9)), oracle::TooManyChannels);
  CHECK_THROWS_AS(horizon_of(unit_scene(3, 1e-9)), oracle::TooManyChannels);
  CHECK(horizon_of(unit_scene(2, 1e-9), 0.2).normals == 20);
  const Horizon wide = horizon_of(unit_scene(3, 1e-9), 0.25);
  CHECK(wide.normals > 85);  // 109 seen
  for (const auto& channel : wide.channels) CHECK(channel.width >= 0.25);
  CHECK_FALSE(wide.no_cylinders.empty());
  for (const int d : {2, 3}) CHECK(horizon_of(unit_scene(d, 1e6)).is_finite());
  CHECK_FALSE(horizon_of(unit_scene(2, 0.1), 5).is_finite());  // of narrow channels nothing is said

  // A least width equal to a channel's keeps it.
  CHECK(horizon_of(unit_scene(2, 0.25), 0.5).channels.size() == 2);
  CHECK(horizon_of(unit_scene(2, 0.25), std::nextafter(0.5, 1)).channels.empty());

  Draw draw(79);
  for (const int d : {2, 3}) {
    Scene crowd = unit_scene(d, 0.01);
    crowd.lattices[0].atoms.resize(10000);
    for (Atom& atom : crowd.lattices[0].atoms) atom = {draw.vec(d, 0, 1), d == 2 ? 0.01 : 0.05, {}};
    CHECK(horizon_of(crowd, 0, false).channels.empty());
  }
  const Scene sliver = scene_with(2, {Vec{1, 1}, Vec{1 + 0x1p-40, 1}}, {{{}, 0.1, {}}});
  CHECK(horizon_of(sliver).channels.size() == 1);
  Scene two = unit_scene(3, 0.2);
  two.lattices.push_back(two.lattices[0]);
  two.lattices[1].vectors[0] = {1, 0.5, 0};
  CHECK_FALSE(horizon_of(two).no_cylinders.empty());
  two.lattices[1].vectors[0] = {1, 0, 0};
  CHECK(horizon_of(two).no_cylinders.empty());
  two.lattices[1].atoms[0].semiaxes = {Vec{0.2, 0, 0}, Vec{0, 0.2, 0}, Vec{0, 0, 0.3}};
  CHECK_FALSE(horizon_of(two).no_cylinders.empty());
}

TEST_CASE("Horizon: no family is named if not all planes were looked at", "[oracle][horizon]") {
  // Planes of normals such as (1, 4, 8) touch, and are found before the work is too much: 10^4 balls at one place.
  const Scene heap =
      scene_with(3, {Vec{9, 0, 0}, Vec{0, 9, 0}, Vec{0, 0, 9}}, std::vector(10'000, Atom{{}, 0.5, {}}));
  const Horizon horizon = horizon_of(heap, 4);
  CHECK_FALSE(horizon.no_cylinders.empty());
  CHECK(horizon.families.empty());
}

TEST_CASE("Horizon: too many directions are counted, not begun, in slender cells too", "[oracle][horizon]") {
  // The ball of candidates has a volume of some hundred cells, and four million points in one plane.
  const Scene slender = scene_with(3, {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0.3, 0.7, 1e-9}}, {{{}, 1e-4, {}}});
  std::size_t steps = 0;
  const auto count = [&](const std::string&, std::size_t, std::size_t) { ++steps; };
  CHECK_THROWS_AS(horizon_of(slender, 0, false, count), oracle::TooManyChannels);
  CHECK_THROWS_AS(horizon_of(slender, 0, true, count), oracle::TooManyChannels);
  CHECK(steps == 0);
  const Horizon wide = horizon_of(slender, 0.2);
  CHECK(wide.normals == 1);
  CHECK_FALSE(wide.no_cylinders.empty());

  // A search that is begun is heard of, to its end.
  std::size_t last = 0, total = 0;
  horizon_of(unit_scene(2, 0.01), 0, true, [&](const std::string& what, std::size_t done, std::size_t all) {
    CHECK(what == "directions");
    CHECK(done >= last);
    last = done, total = all;
  });
  CHECK(total > 3700);  // pi / (4 r^2) / 2, and those on the axis
  CHECK(total < 4100);
  CHECK(last + 64 > total);
}

TEST_CASE("Horizon: an invalid width is refused, not searched for", "[oracle][horizon]") {
  for (const double width : {std::nan(""), -1.0, HUGE_VAL})
    CHECK_THROWS_AS(horizon_of(unit_scene(2, 0.1), width), InputError);
}

namespace {

// Which of the first lattice's ways run along one of the second's; whole numbers, so that it is exact.
std::vector<Vec> shared_ways(const Horizon& a, const Horizon& b) {
  std::vector<Vec> shared;
  for (const Channel& one : a.channels)
    for (const Channel& other : b.channels)
      if (cross(one.vector, other.vector)[2] == 0) {
        shared.push_back(one.vector);
        break;
      }
  return shared;
}

// The same ways, though named by other vectors.
void check_same_ways(const Horizon& a, const Horizon& b) {
  REQUIRE(a.channels.size() == b.channels.size());
  REQUIRE(a.cylinders.size() == b.cylinders.size());
  CHECK(a.normals == b.normals);
  for (std::size_t i = 0; i < a.channels.size(); ++i) CHECK(a.channels[i].width == b.channels[i].width);
  for (std::size_t i = 0; i < a.cylinders.size(); ++i) CHECK(a.cylinders[i].radius == b.cylinders[i].radius);
  CHECK(a.families.size() == b.families.size());
}

}  // namespace

TEST_CASE("Horizon: the normals that two lattices have in common, by looking at all", "[oracle][horizon]") {
  test::Draw draw(20261124);
  const auto whole = [&] { return std::round(draw.vec(2, -40'000, 40'000)[0]); };
  int known = 0, shared = 0, unknown = 0;
  for (int i = 0; i < 400; ++i) {
    std::array<Scene, 2> alone;
    for (Scene& scene : alone) {
      scene = test::one_atom(2, {{{whole(), whole(), 0}, {whole(), whole(), 0}}}, 2000);
      auto& u = scene.lattices[0].vectors;
      if (i % 4 == 1) u = {{{20'000, 0, 0}, {whole(), 31'000, 0}}};  // the same rows
      if (i % 4 == 2) u = {{{whole(), 0, 0}, {0, whole(), 0}}};      // the same rows and columns
      if (i % 4 == 3) u = {{{20'000, 0, 0}, {0, 31'000, 0}}};
      if (i % 8 == 5) scene.lattices[0].atoms[0] = {{}, 0, {{3000, 500, 0}, {-1000, 1000, 0}}};
    }
    // The second has a long way of the first for a short one.
    auto& first = alone[1].lattices[0].vectors[0];
    if (i % 4 == 3) first = {20'000.0 * (1 + i % 3), 31'000.0 * (1 + i % 5), 0};
    const auto area = [](const Scene& scene) {
      return std::fabs(cross(scene.lattices[0].vectors[0], scene.lattices[0].vectors[1])[2]);
    };
    if (area(alone[0]) < 1e8 || area(alone[1]) < 1e8) continue;
    const ChannelScene<2> exact({2, {alone[0].lattices[0], alone[1].lattices[0]}}, 0);
    const auto normals = common_normals(exact.lattices[0], exact.lattices[1]);
    if (!normals) {
      ++unknown;
      continue;
    }
    ++known;
    CHECK(normals->size() <= 2);
    for (const Vec& way : shared_ways(horizon_of(alone[0]), horizon_of(alone[1]))) {
      ++shared;
      const ZVec<2> along = scaled_vector<2>(way, exact.exponent);
      CHECK(std::any_of(normals->begin(), normals->end(),
                        [&](const ZVec<2>& normal) { return dot(normal, along) == 0; }));
    }
  }
  INFO(known << " known, with " << shared << " shared ways; " << unknown << " unknown");
  CHECK(known > 100);
  CHECK(shared > 50);
}

TEST_CASE("Horizon: superposed lattices of tiny discs are decided", "[oracle][horizon]") {
  const auto scenes = test::all_scenes();
  for (const double radius : {1e-4, 1e-7})
    for (const char* name : {"superposition-pi-5", "superposition-pi-5-pi-7"}) {
      INFO(name << ", r = " << radius);
      CHECK(horizon_of(test::with_radius(scenes.at(name), radius)).is_finite());
    }
  // One direction in common, of a cell that is sheared.
  Scene scene = unit_scene(2, 1e-4);
  scene.lattices.push_back(scene.lattices[0]);
  scene.lattices[1].vectors = {{{std::sqrt(2), 0, 0}, {0.3, std::sqrt(3), 0}}};
  const Horizon horizon = horizon_of(scene);
  REQUIRE(horizon.channels.size() == 1);
  CHECK(horizon.channels[0].vector == Vec{1, 0, 0});
  CHECK(horizon.channels[0].width == Approx(1 - 2e-4));
  // So small that rounded numbers have much in common.
  CHECK_THROWS_AS(horizon_of(test::with_radius(scenes.at("superposition-pi-5"), 1e-12)), TooManyChannels);
  // In step they have as many as one has.
  scene.lattices[1].vectors = scene.lattices[0].vectors;
  CHECK_THROWS_AS(horizon_of(scene), TooManyChannels);
}

TEST_CASE("Horizon: the one corridor of two lattices, between rows far out", "[oracle][horizon]") {
  // Ellipses 1/650 apart across (650, 1), and as wide as 0.92 of that; across (1, 650) they overlap.
  Scene scene = scene_with(2, {Vec{1, 0}, Vec{0, 1}}, {{{}, 0, {Vec{0.0005, 0.006}, Vec{0.0005, 0}}}});
  const double odd = 1.4140625;
  scene.lattices.push_back({{Vec{odd, -650 * odd}, Vec{std::sqrt(3), std::sqrt(0.1)}}, {{{}, 0.5, {}}}});
  const Horizon horizon = horizon_of(scene);
  REQUIRE(horizon.channels.size() == 1);
  CHECK(horizon.channels[0].vector == Vec{1, -650});
}

TEST_CASE("Horizon: two centred rectangular lattices, and the same as rectangles with two discs",
          "[oracle][horizon]") {
  // The short products of their normals, (1, 0, 0, 1) and (0, 1, 1, 0), are of rank two.
  Scene centred, rectangles;
  centred.dimension = rectangles.dimension = 2;
  for (const Vec& side : {Vec{1, 1}, Vec{std::sqrt(2), std::sqrt(3)}}) {
    const double x = side[0] / 2, y = side[1] / 2, r = 0.01;
    centred.lattices.push_back({{Vec{x, y}, Vec{x, -y}}, {{{}, r, {}}}});
    rectangles.lattices.push_back({{Vec{2 * x, 0}, Vec{0, 2 * y}}, {{{}, r, {}}, {{x, y}, r, {}}}});
  }
  const Horizon one = horizon_of(centred), other = horizon_of(rectangles);
  CHECK(one.normals == 2);
  CHECK(other.normals == 2);
  REQUIRE(one.channels.size() == 2);
  for (const auto& channel : one.channels) {  // the widest of its direction
    const auto same = std::find_if(other.channels.begin(), other.channels.end(),
                                   [&](const auto& each) { return each.vector == channel.vector; });
    REQUIRE(same != other.channels.end());
    CHECK(same->width == channel.width);
  }
}

TEST_CASE("Horizon: rows that a shear leaves in place are one corridor, named once", "[oracle][horizon]") {
  // Tall ellipses: for the products of normals (0, 1, -1, 0) is shorter than that of the rows.
  const std::vector<Vec> tall{{0.001, 0, 0}, {0, 0.1, 0}};
  Scene scene = scene_with(2, {Vec{1, 0}, Vec{0, 1}}, {{{}, 0, tall}});
  scene.lattices.push_back({{Vec{1, 0}, Vec{-std::sqrt(2), 1}}, {{{}, 0, tall}}});
  const Horizon horizon = horizon_of(scene);
  REQUIRE(horizon.channels.size() == 1);
  CHECK(horizon.channels[0].vector == Vec{1, 0});
  CHECK(horizon.channels[0].width == 0.8);
}

TEST_CASE("Horizon: vectors skewed by 10^300 span the same lattice, and cost no more", "[oracle][horizon]") {
  const Vec e1{1, 0, 0}, e3{0, 0, 1};
  for (const double skew : {3.0, 0x1p60, 1e300}) {
    INFO(skew);
    const Horizon plane = horizon_of(scene_with(2, {e1, Vec{skew, 1}}, {{{}, 0.1, {}}}));
    const Horizon square = horizon_of(unit_scene(2, 0.1));
    check_same_ways(square, plane);
    CHECK(*plane.tail_constant == Approx(*square.tail_constant).epsilon(1e-12));
    // Its own vectors name them: the corridor along e2 is u2 - skew u1.
    bool named = false;
    for (const auto& channel : plane.channels)
      named |= std::fabs(channel.vector[1]) == 1 && channel.width == 0.8;
    CHECK(named);
    for (const double radius : {0.25, 0.45}) {
      const Horizon cubic = horizon_of(unit_scene(3, radius));
      const Horizon skewed = horizon_of(scene_with(3, {e1, Vec{skew, 1, 0}, e3}, {{{}, radius, {}}}));
      check_same_ways(cubic, skewed);
      CHECK(*skewed.tail_constant == Approx(*cubic.tail_constant).epsilon(1e-12));
      for (const auto& cylinder : skewed.cylinders) CHECK(cylinder.inside);
    }
  }
}

TEST_CASE("Horizon: the indices in skewed vectors are those of the vector that stands beside them",
          "[oracle][horizon]") {
  const std::vector<Vec> u{{1, 0, 0}, {7, 1, 0}, {-3, 5, 1}};
  const Horizon skewed = horizon_of(scene_with(3, {u[0], u[1], u[2]}, {{{}, 0.4, {}}}));
  REQUIRE(skewed.channels.size() == 3);
  for (const auto& channel : skewed.channels)  // planes (h k l): u_i . k = the i-th index
    for (int i = 0; i < 3; ++i) {
      double product = 0;
      for (int k = 0; k < 3; ++k) product += u[i][k] * channel.vector[k];
      CHECK(product == static_cast<double>(channel.indices[i].int64()));
    }
  CHECK_FALSE(skewed.cylinders.empty());
  for (const auto& cylinder : skewed.cylinders) {
    std::int64_t first = 0;
    for (int i = 0; i < 3 && first == 0; ++i) first = cylinder.direction[i].int64();
    CHECK(first > 0);
    for (int k = 0; k < 3; ++k) {
      double sum = 0;
      for (int i = 0; i < 3; ++i) sum += static_cast<double>(cylinder.direction[i].int64()) * u[i][k];
      CHECK(sum == cylinder.vector[k]);
    }
  }
}

TEST_CASE("Horizon: thousands of lattices, and thousands of lattices that leave little, are given up",
          "[oracle][horizon]") {
  Draw draw(83);
  Scene scene = unit_scene(2, 0.1);
  for (int i = 0; i < 5000; ++i) {
    scene.lattices.push_back(scene.lattices[0]);
    scene.lattices.back().vectors[0][0] = 1 + i * 1e-5;
    scene.lattices.back().vectors[1][1] = 1 + i * 2e-5;
    scene.lattices.back().atoms[0].position = draw.vec(2, 0, 1);
  }
  CHECK_THROWS_AS(horizon_of(scene), oracle::TooManyChannels);
}
