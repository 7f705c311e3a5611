// Cylindrical channels: near close packing, in shadows whose discs just touch, in holes however small, among
// ellipsoids however they are written.
#include <lorentz/geometry.hpp>
#include <lorentz/horizon.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

#include <lorentz/oracle.hpp>
#include "oracle/horizon/shadow.hpp"
#include "tests/oracle/horizon_support.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using oracle::Horizon;
using oracle::horizon_of;

TEST_CASE("Horizon: simple, face-centred and body-centred cubic near close packing", "[oracle][horizon]") {
  const std::array<Vec, 3> fcc{Vec{0, 0.5, 0.5}, Vec{0.5, 0, 0.5}, Vec{0.5, 0.5, 0}},
      bcc{Vec{-0.5, 0.5, 0.5}, Vec{0.5, -0.5, 0.5}, Vec{0.5, 0.5, -0.5}};
  const auto with = [](const std::array<Vec, 3>& vectors, double r) {
    return horizon_of(scene_with(3, vectors, {{{}, r, {}}}));
  };
  // Planar channels: the widest planes are (100), sqrt(1/3), sqrt(1/2) apart.
  CHECK(horizon_of(unit_scene(3, std::nextafter(0.5, 0))).channels.size() == 3);
  CHECK(horizon_of(unit_scene(3, 0.5)).channels.empty());
  CHECK(with(fcc, 0.2886).channels.size() == 4);
  CHECK(with(fcc, 0.2887).channels.empty());
  CHECK(with(bcc, 0.3535).channels.size() == 6);
  CHECK(with(bcc, 0.3536).channels.empty());
  // Cylindrical: fcc along <110> up to r = 3/8, <100> to sqrt(1/8); bcc along <100> to 1/2, <111> to
  // sqrt(2)/3, <110> to sqrt(3)/4, where the balls touch.
  CHECK(with(fcc, 0.35).cylinders.size() == 9);
  CHECK(with(fcc, 0.3535).cylinders.size() == 9);
  CHECK(with(fcc, 0.3536).cylinders.size() == 6);
  CHECK(with(fcc, 0.375).is_finite());
  CHECK(with(bcc, 0.433).cylinders.size() == 13);
  CHECK(with(bcc, 0.4331).cylinders.size() == 7);
  CHECK(with(bcc, 0.4715).cylinders.size() == 3);
  CHECK(with(bcc, 0.5).is_finite());
  // sc at r = 1/2: the planes touch, and infinitely many directions in them are open, ever less so.
  const Horizon touching = horizon_of(unit_scene(3, 0.5));
  CHECK(touching.families.size() == 3);
  CHECK(touching.cylinders.empty());
  CHECK(touching.is_infinite());
  // A little more: very many, which are not all searched.
  const Horizon nearly = horizon_of(unit_scene(3, 0.5 + 0x1p-40));
  REQUIRE(nearly.families.size() == 3);
  CHECK_FALSE(nearly.families[0].infinite);
  // With 2^39 = g^2 the discs in a row, 1/|g| apart, cover slabs that touch: pi g^2 / 2 pairs, 6 / pi^2
  // primitive.
  CHECK(nearly.families[0].directions == Approx(3 / M_PI * 0x1p39).epsilon(1e-3));
  CHECK(nearly.is_infinite());
  CHECK(nearly.cylinders.size() > 2300);  // 2 937 seen
  CHECK(horizon_of(unit_scene(3, std::sqrt(0.5))).is_finite());
}

TEST_CASE("Horizon: a shadow of equal discs has a hole where the circumradius says so", "[oracle][horizon]") {
  Draw draw(78);
  int holes = 0, covered = 0;
  for (int round = 0; round < 400; ++round) {
    Scene scene = short_scene(draw, 3, 1, 0.2, 1);
    const oracle::ChannelScene<3> exact(scene, 0);
    const auto& lattice = exact.lattices[0];
    const auto &u = lattice.given[0], &v = lattice.given[1], &w = lattice.given[2];
    const oracle::Shadow shadow(lattice, u, v, w);
    std::size_t work = 0;
    const bool by_radius = oracle::hole_of_largest(shadow).has_value();
    CHECK(oracle::hole_of_all(shadow, work).has_value() == by_radius);
    (by_radius ? holes : covered)++;
  }
  CHECK(holes > 220);   // 285 seen
  CHECK(covered > 90);  // 115 seen
}

TEST_CASE("Horizon: shadows whose discs just touch, or just close", "[oracle][horizon]") {
  const auto hole = [](std::array<Vec, 3> vectors, std::vector<Atom> atoms) {
    const oracle::ChannelScene<3> exact(scene_with(3, vectors, std::move(atoms)), 0);
    const auto& lattice = exact.lattices[0];
    oracle::Shadow shadow(lattice, lattice.given[2], lattice.given[0], lattice.given[1]);
    shadow.see(lattice, lattice.obstacles.size());
    std::size_t work = 0;
    return oracle::hole_of_all(shadow, work).has_value();
  };
  const std::array<Vec, 3> unit{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  // Between discs that touch there is a hole, all of whose corners are cusps.
  CHECK(hole(unit, {{{}, 0.5, {}}}));
  CHECK(hole(unit, {{{}, 0.25, {}}}));  // no two circles meet
  // Circumradius 5: at r = 5 four circles meet in one free point, which is not a hole.
  const std::array<Vec, 3> seven{Vec{7, 1, 0}, Vec{-1, 7, 0}, Vec{0, 0, 1}};
  CHECK_FALSE(hole(seven, {{{}, 5, {}}}));
  CHECK(hole(seven, {{{}, std::nextafter(5.0, 0), {}}}));
  // A smaller ball in that hole: it fills it, or not, or touches from within.
  CHECK(hole(unit, {{{}, 0.5, {}}, {{0.5, 0.5, 0}, 0.25, {}}}));
  CHECK_FALSE(hole(unit, {{{}, 0.5, {}}, {{0.5, 0.5, 0}, 0.5, {}}}));
  CHECK_FALSE(hole(unit, {{{}, 0.75, {}}, {{0.25, 0, 0}, 0.5, {}}}));
  CHECK(hole(unit, {{{}, 0.5, {}}, {{0.25, 0, 0}, 0.25, {}}}));
  // All corners of the hole are on three circles.
  CHECK(hole(unit, {{{}, 0.5, {}}, {{0.25, 0, 0}, 0.25, {}}, {{0, 0.25, 0}, 0.25, {}}}));
  // The same ball twice in one line of sight, or a smaller one behind a larger.
  CHECK(hole(unit, {{{}, 0.5, {}}, {{0, 0, 0.5}, 0.5, {}}}));
  CHECK_FALSE(hole(seven, {{{}, 5, {}}, {{0, 0, 0.5}, 5, {}}}));
  CHECK_FALSE(hole(seven, {{{}, 5, {}}, {{0, 0, 0.5}, 0.25, {}}}));
  // A disc behind a ring of smaller ones: on the hole border these alone.
  std::vector<Atom> ring{{{}, 1, {}}};
  for (int i = 0; i < 12; ++i)
    ring.push_back({{std::cos(M_PI / 6 * i), std::sin(M_PI / 6 * i), 0}, 0.625, {}});
  CHECK(hole({Vec{4, 0, 0}, Vec{0, 4, 0}, Vec{0, 0, 1}}, ring));
}

namespace {

// Directions and radii of the cylinders.
std::vector<std::pair<std::string, double>> cylinders_of(const Horizon& horizon) {
  std::vector<std::pair<std::string, double>> result;
  for (const auto& cylinder : horizon.cylinders)
    result.push_back({key_of(cylinder.direction), cylinder.radius});
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

TEST_CASE("Horizon: semiaxes in any order, with any signs, or turned among themselves are one shape",
          "[oracle][horizon]") {
  const Vec a{0.25, 0.125, 0}, b{-0.0625, 0.375, 0.125}, c{0, 0.125, 0.4375};
  const auto minus = [](const Vec& v) { return Vec{-v[0], -v[1], -v[2]}; };
  const std::array<Vec, 3> unit{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  const auto with = [&](std::vector<Vec> first, std::vector<Vec> second) {
    return horizon_of(
        scene_with(3, unit, {{{}, 0, std::move(first)}, {{0.5, 0.5, 0.5}, 0, std::move(second)}}));
  };
  const Horizon same = with({a, b, c}, {a, b, c});
  REQUIRE(same.no_cylinders.empty());
  REQUIRE(same.cylinders.size() > 5);
  for (const auto& second :
       {std::vector{b, c, a}, std::vector{b, a, c}, std::vector{minus(c), b, minus(a)}}) {
    const Horizon other = with({a, b, c}, second), both = with(second, second);
    CHECK(other.no_cylinders.empty());
    REQUIRE(other.cylinders.size() == same.cylinders.size());
    REQUIRE(both.cylinders.size() == same.cylinders.size());
    for (std::size_t i = 0; i < same.cylinders.size(); ++i) {
      CHECK(cylinders_of(other)[i].first == cylinders_of(same)[i].first);
      CHECK(cylinders_of(other)[i].second == Approx(cylinders_of(same)[i].second));
      CHECK(cylinders_of(both)[i].first == cylinders_of(same)[i].first);
    }
    for (const auto& cylinder : other.cylinders) CHECK(cylinder.inside);
  }
  // Nearly the same is another shape.
  CHECK_FALSE(with({a, b, c}, {b, a, {0, 0.125, std::nextafter(0.4375, 1)}}).no_cylinders.empty());

  // Balls of radius 5/16, the second one written with 3-4-5 semiaxes.
  const std::vector<Vec> turned{{0, 0.1875, -0.25}, {-0.3125, 0, 0}, {0, 0.25, 0.1875}};
  const Horizon balls = horizon_of(
      scene_with(3, unit, {{{}, 0.375, {}}, {{0.5, 0.5, 0.5}, 0.3125, {}}, {{0.5, 0, 0}, 0.0625, {}}}));
  const Horizon written = horizon_of(
      scene_with(3, unit, {{{}, 0.375, {}}, {{0.5, 0.5, 0.5}, 0, turned}, {{0.5, 0, 0}, 0.0625, {}}}));
  CHECK(written.no_cylinders.empty());
  CHECK(written.cylinders.size() > 10);
  CHECK(cylinders_of(written) == cylinders_of(balls));
}

TEST_CASE("Horizon: nine balls in a large cell leave the cylinders that one leaves in a small one",
          "[oracle][horizon]") {
  Scene many = scene_with(3, {Vec{9, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}, {});
  for (int n = 0; n < 9; ++n) many.lattices[0].atoms.push_back({{n + 0.0, 0, 0}, 0.65, {}});
  const auto small = cylinders_of(horizon_of(unit_scene(3, 0.65))), large = cylinders_of(horizon_of(many));
  REQUIRE(small.size() == 3);
  REQUIRE(large.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(large[i].first == small[i].first);  // <100>
    CHECK(large[i].second == Approx(small[i].second).epsilon(1e-9));
  }
}

TEST_CASE("Horizon: the widest cylinders come first", "[oracle][horizon]") {
  const Horizon horizon = horizon_of(unit_scene(3, 0.55));
  REQUIRE(horizon.cylinders.size() == 9);
  for (std::size_t i = 0; i < 9; ++i) {  // <100>, <110>
    CHECK(dot(horizon.cylinders[i].vector, horizon.cylinders[i].vector) == (i < 3 ? 1 : 2));
    CHECK(horizon.cylinders[i].radius == Approx(std::sqrt(i < 3 ? 0.5 : 0.375) - 0.55).epsilon(1e-12));
  }
}

TEST_CASE("Horizon: rows of large balls and small ones, as far as they leave holes", "[oracle][horizon]") {
  // Along (1, n, 0) both kinds stand in rows of discs 1 / sqrt(1 + n^2) apart; slabs z = const overlap by
  // 1/200.
  const double large = 0.375, small = 0.15;
  const Horizon horizon = horizon_of(
      scene_with(3, {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}, {{{}, large, {}}, {{0, 0, 0.5}, small, {}}}));
  std::set<std::string> open, expected;
  for (const auto& [direction, radius] : cylinders_of(horizon))
    if (direction.substr(0, 2) == "1 " && direction.substr(direction.size() - 2) == " 0")
      open.insert(direction);
  for (int n = 1; n < 40; ++n) {
    const double half2 = 0.25 / (1 + n * n),
                 covered = std::sqrt(large * large - half2) + std::sqrt(std::max(0.0, small * small - half2));
    for (const int way : {1, -1})
      if (covered < 0.5 || half2 > small * small) expected.insert("1 " + std::to_string(way * n) + " 0");
  }
  CHECK(expected.size() == 12);
  CHECK(open == expected);
}

TEST_CASE("Horizon: planes that touch in one place are a family, wherever they overlap",
          "[oracle][horizon]") {
  for (const double way : {1, -1}) {
    const Horizon horizon = horizon_of(scene_with(3, {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}},
                                                  {{{}, 0.375, {}}, {{0, 0, way * 0.4375}, 0.1875, {}}}));
    REQUIRE(horizon.families.size() == 1);
    CHECK(key_of(horizon.families[0].indices) == "0 0 1");
    CHECK(horizon.families[0].infinite);
  }
}

TEST_CASE("Horizon: cylinders between balls of two lattices with the same vectors, or of one",
          "[oracle][horizon]") {
  for (const double second : {0.375, 0.5}) {  // smaller than the first, or larger
    Scene one = unit_scene(3, 0.4375);
    Scene two = one;
    one.lattices[0].atoms.push_back({{0.5, 0.5, 0.375}, second, {}});
    two.lattices.push_back({two.lattices[0].vectors, {{{0.5, 0.5, 0.375}, second, {}}}});
    const Horizon motif = horizon_of(one), superposed = horizon_of(two);
    REQUIRE(motif.cylinders.size() > 3);
    CHECK(cylinders_of(motif) == cylinders_of(superposed));
    for (const auto& cylinder : superposed.cylinders) CHECK(cylinder.inside);
  }
}

TEST_CASE("Horizon: among ellipsoids that differ no cylinder is named, whichever differs",
          "[oracle][horizon]") {
  const std::vector<Vec> lying{{0.375, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}},
      upright{{0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.375}};
  const Atom ball{{}, 0.45, {}}, first{{}, 0, lying}, second{{}, 0, upright};
  for (std::vector<Atom> atoms : {std::vector{first, second, first},
                                  {second, first, first},
                                  {first, first, second},
                                  {first, ball, ball},
                                  {ball, ball, first}}) {
    for (std::size_t i = 0; i < 3; ++i) atoms[i].position = {0.25 * static_cast<double>(i), 0, 0.5};
    std::vector<Lattice> alone;
    for (const Atom& atom : atoms) alone.push_back({unit_scene(3, 1).lattices[0].vectors, {atom}});
    for (const Scene& scene : {Scene{3, {{alone[0].vectors, atoms}}}, Scene{3, alone}}) {
      const Horizon horizon = horizon_of(scene);
      CHECK_FALSE(horizon.no_cylinders.empty());
      CHECK(horizon.cylinders.empty());
      CHECK(horizon.families.empty());
    }
  }
}

TEST_CASE("Horizon: balls stretched along a cylinder leave it as wide, and no less than its share is named",
          "[oracle][horizon]") {
  // What fits is divided by sqrt(1 + 1 + 1/4), the norm of the map back over that across the cylinder.
  const std::vector<Vec> axes{{0.625, 0, 0}, {0, 0.625, 0}, {0, 0, 1.25}};
  const Horizon horizon =
      horizon_of(scene_with(3, {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 2}}, {{{}, 0, axes}}));
  const double fits = std::sqrt(0.5) - 0.625;
  REQUIRE_FALSE(horizon.cylinders.empty());
  for (const auto& cylinder : horizon.cylinders)
    if (cylinder.vector == Vec{0, 0, 2}) CHECK(cylinder.radius == Approx(fits / 1.5).epsilon(1e-12));
  CHECK(std::any_of(horizon.cylinders.begin(), horizon.cylinders.end(), [](const auto& cylinder) {
    return cylinder.vector == Vec{0, 0, 2};
  }));
}

TEST_CASE("Horizon: the radius of a cylinder is above 0 however small the hole", "[oracle][horizon]") {
  // Between four balls of a square: sqrt(1/2) - r. A second ball in each line of sight changes nothing.
  const std::array<Vec, 3> unit{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  const double r = 0.7071067811865475;
  const __float128 rest = 0.5 - static_cast<__float128>(r) * r;
  const double expected = static_cast<double>(rest / (2 * static_cast<__float128>(r) + rest / 1.5));
  const Horizon one = horizon_of(unit_scene(3, r));
  REQUIRE(one.cylinders.size() == 3);
  for (const auto& cylinder : one.cylinders) CHECK(cylinder.radius == Approx(expected).epsilon(1e-14));
  const Horizon two =
      horizon_of(scene_with(3, unit, {{{}, r, {}}, {{0, 0, 0.5}, r, {}}, {{0.25, 0.25, 0.25}, 0.0625, {}}}));
  REQUIRE(two.cylinders.size() == 1);
  CHECK(two.cylinders[0].radius == Approx(expected).epsilon(1e-9));
  CHECK(two.cylinders[0].inside);

  // Four discs of radius 5 about the point (3, 4), one of them moved away by 5 e: next to two discs that
  // touch there, the cusp has room for a circle of radius (5 e)^2 / 10, or, around the corner, less yet.
  const double e = 0x1p-100;
  const Horizon cusp = horizon_of(scene_with(
      3, {Vec{14, 2, 0}, Vec{-2, 14, 0}, Vec{0, 0, 1}},
      {{{-3 * e, -4 * e, 0}, 5, {}}, {{7, 1, 0}, 5, {}}, {{-1, 7, 0}, 5, {}}, {{6, 8, 0}, 5, {}}}));
  REQUIRE(cusp.cylinders.size() == 1);
  CHECK(cusp.cylinders[0].radius > 0);
  CHECK(cusp.cylinders[0].radius < 3 * e * e);
  CHECK_FALSE(cusp.cylinders[0].inside);  // of binary64 points only (3, 4) is near enough, and on a circle

  // A hole of 4e-7 where binary64 has only multiples of 2^-16 along x: the line named is in a ball.
  const Scene far = scene_with(3, {Vec{1, 0.125, 0}, Vec{0.375, 0.875, 0}, Vec{0, 0, 1}},
                               {{{0x1p36, 0, 0}, 592979 * 0x1p-20, {}}});
  const auto cylinders = horizon_of(far).cylinders;
  const auto upright = std::find_if(cylinders.begin(), cylinders.end(), [](const auto& cylinder) {
    return cylinder.vector == Vec{0, 0, 1};
  });
  REQUIRE(upright != cylinders.end());
  CHECK_FALSE(upright->inside);
  CHECK(oracle::Oracle(far).first_hit({upright->point, {0, 0, 1}, {}}).outcome != Outcome::never);

  // A cylinder of that radius fits: no ball is nearer to the line, as binary64 sees it.
  Draw draw(80);
  std::size_t seen = 0;
  for (int round = 0; round < 20; ++round) {
    const Scene scene = short_scene(draw, 3, 3, 0.3, 0.5);
    const auto& u = scene.lattices[0].vectors;
    for (const auto& cylinder : horizon_of(scene).cylinders) {
      const Vec& g = cylinder.vector;
      double least = 1e9;
      for (const Atom& atom : scene.lattices[0].atoms)
        for (int n = 0; n < 9 * 9 * 9; ++n) {
          Vec arm{};
          for (int k = 0; k < 3; ++k)
            arm[k] = atom.position[k] + (n % 9 - 4) * u[0][k] + (n / 9 % 9 - 4) * u[1][k] +
                     (n / 81 - 4) * u[2][k] - cylinder.point[k];
          const Vec across = cross(arm, g);
          least = std::min(least, std::sqrt(dot(across, across) / dot(g, g)) - atom.radius);
        }
      CHECK(least >= cylinder.radius - 1e-14);
      seen += least < cylinder.radius + 1e-9;
    }
  }
  CHECK(seen > 500);
}
