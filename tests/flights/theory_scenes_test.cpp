// What theory says of scenes: against closed forms, counting, and the oracle's channels.
#include "statistics/theory/incommensurate.hpp"
#include "statistics/theory/laws.hpp"
#include "statistics/theory/small_obstacles.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include <lorentz/geometry.hpp>
#include <lorentz/horizon.hpp>
#include "question/cases/random.hpp"
#include "src/problem/scene_geometry.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::flights;

namespace {

constexpr double kPi = std::numbers::pi;

Lattice turned(Lattice lattice, double angle, double factor = 1) {
  for (Vec& u : lattice.vectors)
    u = {factor * (std::cos(angle) * u[0] - std::sin(angle) * u[1]),
         factor * (std::sin(angle) * u[0] + std::cos(angle) * u[1]), u[2]};
  return lattice;
}

// Square lattices, each turned by its angle.
Scene turned_squares(double radius, const std::vector<double>& angles) {
  Scene scene = unit_scene(2, radius);
  const Lattice square = scene.lattices[0];
  scene.lattices.clear();
  for (const double angle : angles) scene.lattices.push_back(turned(square, angle));
  return scene;
}

const Tail* tail_when(const std::vector<Tail>& tails, const std::string& when) {
  for (const Tail& tail : tails)
    if (tail.when == when) return &tail;
  return nullptr;
}

}  // namespace

TEST_CASE("Laws: one lattice of discs, in any cell", "[flights][laws]") {
  const Scene scene = test::one_atom(2, {{{2, 0, 0}, {0.5, 1.5, 0}}}, 0.003);  // area 3
  for (const auto ensemble : {Ensemble::uniform, Ensemble::surface}) {
    const auto law = law_of(scene, ensemble);
    REQUIRE(law);
    CHECK(law->when == "r -> 0");
    CHECK(law->scale == Approx(500));
    CHECK(law->smooth_from == (ensemble == Ensemble::uniform ? 0 : 128));  // 64 of the longest vector
    for (const double s : {0.3, 1.7, 12.0})
      CHECK(law->survival(500 * s) == Approx(ensemble == Ensemble::uniform ? limit_survival_from_uniform(s)
                                                                           : limit_survival_from_surface(s))
                                          .epsilon(1e-12));
  }
}

TEST_CASE("Laws: superposed lattices", "[flights][laws]") {
  Scene scene = turned_squares(1e-4, {0, kPi / 5, kPi / 7});
  const auto uniform = law_of(scene, Ensemble::uniform);
  REQUIRE(uniform);
  CHECK(uniform->survival(5000) == Approx(0.028084).epsilon(1e-4));
  scene.lattices[1].atoms[0].radius = 3e-4;
  scene.lattices[2] = turned(scene.lattices[2], 0, 1.7);
  const Law from_uniform = *law_of(scene, Ensemble::uniform),
            from_surface = *law_of(scene, Ensemble::surface);
  const double mean = 1 / (2e-4 + 6e-4 + 2e-4 / (1.7 * 1.7));
  CHECK(from_uniform.scale == Approx(mean));
  // The density from a uniform start is the survival from collisions over their mean.
  for (const double t : {10.0, 700.0, 1500.0, 4000.0, 20'000.0}) {
    INFO("t = " << t);
    const double step = 1e-4 * t,
                 density = (from_uniform.survival(t - step) - from_uniform.survival(t + step)) / (2 * step);
    CHECK(density == Approx(from_surface.survival(t) / mean).epsilon(1e-6));
  }
  CHECK(from_surface.survival(0) == Approx(1).epsilon(1e-14));
}

TEST_CASE("Laws: ellipses, as discs of another lattice seen in another light", "[flights][laws]") {
  // Almost round: the disc's law. Ellipses as wide as they are long across a direction: its mean width.
  Scene round = unit_scene(2, 0.001), nearly = round;
  nearly.lattices[0].atoms[0] = {{}, 0, {{0.001, 0, 0}, {0, 0.001 * (1 + 1e-9), 0}}};
  for (const auto ensemble : {Ensemble::uniform, Ensemble::surface})
    for (const double t : {100.0, 800.0, 3000.0})
      CHECK(law_of(nearly, ensemble)->survival(t) ==
            Approx(law_of(round, ensemble)->survival(t)).epsilon(1e-8));
  // Mean width is perimeter over pi, so that the mean is Santalo's.
  Scene slender = unit_scene(2, 1);
  slender.lattices[0].atoms[0] = {{}, 0, {{0.003, 0.001, 0}, {-0.0002, 0.0006, 0}}};
  CHECK(law_of(slender, Ensemble::uniform)->scale ==
        Approx(kPi / surface_of(slender.lattices[0].atoms[0], 2)).epsilon(1e-9));
}

TEST_CASE("Laws: none where none is known, and why", "[flights][laws]") {
  const auto reason = [](const Scene& scene) {
    std::string why_not;
    CHECK_FALSE(law_of(scene, Ensemble::uniform, &why_not));
    return why_not;
  };
  CHECK(reason(unit_scene(3, 0.1)).find("3D") != std::string::npos);
  CHECK(reason(test::all_scenes().at("honeycomb")).find("several obstacles") != std::string::npos);
  for (const double angle : {std::atan(0.75), std::atan(5 / 12.0), kPi / 4, 0.0, kPi / 2})
    CHECK(reason(turned_squares(1e-4, {0, angle})).find("commensurable") != std::string::npos);
}

TEST_CASE("Commensurable lattices: by small integers, whatever the size", "[flights][laws]") {
  const Lattice square = unit_scene(2, 0.1).lattices[0];
  // Turns whose tangent is rational, and any factor besides.
  CHECK(commensurable(square, turned(square, std::atan(0.75), 1.234567), 2));
  CHECK(commensurable(turned(square, 0.3), turned(square, 0.3 + std::atan(17 / 23.0)), 2));
  CHECK(commensurable(square, turned(square, 0, std::sqrt(2)), 2));
  CHECK(commensurable(square, turned(square, std::atan(1 / 997.0)), 2));
  CHECK(commensurable(square, {{Vec{-1, 0, 0}, Vec{0, -1, 0}}, {}}, 2));
  CHECK_FALSE(commensurable(square, turned(square, std::atan(1 / 1009.0)), 2));  // beyond what is tried
  CHECK_FALSE(commensurable(square, turned(square, kPi / 5), 2));
  CHECK_FALSE(commensurable(square, turned(square, kPi / 7), 2));
  Lattice rectangle = square, triangular = square;
  rectangle.vectors[1][1] = std::sqrt(2);
  triangular.vectors[1] = {0.5, std::sqrt(3) / 2, 0};
  CHECK_FALSE(commensurable(square, rectangle, 2));
  CHECK_FALSE(commensurable(square, triangular, 2));
  CHECK(commensurable(triangular, turned(triangular, kPi / 2, std::sqrt(3)), 2));
  // Lattices drawn at random; the seed is 5.
  test::Draw draw(5);
  int found = 0;
  for (int i = 0; i < 1000; ++i) {
    Lattice a = square, b = square;
    for (int k = 0; k < 2; ++k) a.vectors[k] = draw.vec(2, -1, 1), b.vectors[k] = draw.vec(2, -1, 1);
    found += commensurable(a, b, 2);
  }
  CHECK(found == 0);
}

TEST_CASE("Independent lattices: no reciprocal vectors add up", "[flights][mean]") {
  CHECK(independent(turned_squares(0.1, {0, kPi / 5, kPi / 7})));
  CHECK_FALSE(independent(turned_squares(0.1, {0, std::atan(0.75)})));
  // Shares the planes x = const with the square: incommensurable, but not independent.
  Scene columns = turned_squares(0.1, {0, 0});
  columns.lattices[1].vectors[1][1] = std::sqrt(2);
  CHECK_FALSE(commensurable(columns.lattices[0], columns.lattices[1], 2));
  CHECK_FALSE(independent(columns));
  // As many columns, 50 to a cell, to 5e-10 of their distance.
  columns.lattices[1].vectors[0][0] = 50 * (1 + 5e-10);
  CHECK_FALSE(independent(columns));
  // Three of which no two share anything, but k1 + k2 = k3.
  Scene three = turned_squares(0.1, {0, 0.7, 0});
  three.lattices[1] = turned(three.lattices[0], 0.7, 1.3);
  const double c = std::cos(0.7) / 1.3, s = std::sin(0.7) / 1.3;
  // Reciprocal: (1 + c, s) and one more; u1 . k = 1, and u2 along the planes of k.
  const Vec k{1 + c, s, 0};
  const double k2 = k[0] * k[0] + k[1] * k[1];
  three.lattices[2].vectors = {{{k[0] / k2, k[1] / k2, 0}, {-0.8123 * k[1], 0.8123 * k[0], 0}}};
  for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}})
    CHECK(independent({2, {three.lattices[a], three.lattices[b]}}));
  CHECK_FALSE(independent(three));
  Scene cubes = unit_scene(3, 0.1);
  cubes.lattices.push_back(turned(cubes.lattices[0], kPi / 5));  // about the z axis: shares its planes
  CHECK_FALSE(independent(cubes));
}

TEST_CASE("What lattices have in common does not depend on their bases", "[flights][laws]") {
  const auto skewed = [](Scene scene, std::size_t which, double times) {
    auto& vectors = scene.lattices[which].vectors;
    for (int k = 0; k < 3; ++k) vectors[1][k] += times * vectors[0][k];
    return scene;
  };
  Scene columns = turned_squares(0.1, {0, 0});
  columns.lattices[1].vectors[1][1] = std::sqrt(2);
  columns.lattices[1].atoms[0].position = {0.5, 0, 0};
  Scene cubes = unit_scene(3, 0.1);
  cubes.lattices.push_back(turned(cubes.lattices[0], kPi / 5));
  Scene turns = turned_squares(0.1, {0, std::atan(20 / 21.0)});
  for (Vec& vector : turns.lattices[0].vectors) vector = scaled(vector, 29);
  const Scene none = turned_squares(0.1, {0, kPi / 5});
  for (const std::size_t which : {0, 1})
    for (const double times : {1, 7, 50, 101, 1009, 123457}) {
      INFO(which << " " << times);
      CHECK_FALSE(independent(skewed(columns, which, times)));
      CHECK_FALSE(independent(skewed(cubes, which, times)));
      CHECK(independent(skewed(none, which, times)));
      CHECK(mean_free_path_of(skewed(columns, which, times)).value.value() ==
            Approx(mean_free_path_of(columns).value.value()));
      const auto two = [](const Scene& scene) {
        return commensurable(scene.lattices[0], scene.lattices[1], 2);
      };
      CHECK(two(skewed(turns, which, times)));
      CHECK_FALSE(two(skewed(columns, which, times)));
      CHECK_FALSE(two(skewed(none, which, times)));
      const Scene rounded = skewed(turned_squares(0.01, {0, std::atan(0.75)}), which, times);
      if (times < 1000) CHECK(nearly_common_way(rounded).has_value());
    }
}

TEST_CASE("Many lattices are compared soon, more than a few tens not at all", "[flights][mean]") {
  test::Draw draw(17);
  Scene scene{2, {}};
  while (scene.lattices.size() < kMostLattices) {
    Lattice lattice = unit_scene(2, 0.01).lattices[0];
    for (int k = 0; k < 2; ++k)
      lattice.vectors[k][k] += draw.between(0, 1), lattice.vectors[k][1 - k] = draw.between(0, 0.5);
    scene.lattices.push_back(lattice);
  }
  CHECK(independent(scene));
  CHECK(mean_free_path_of(scene).value.has_value());
  scene.lattices.push_back(turned(scene.lattices[0], 0.3));
  const MeanFreePath of_more = mean_free_path_of(scene);
  CHECK_FALSE(of_more.value.has_value());
  CHECK(of_more.how == "not given: more than 24 lattices are not compared");
  scene.lattices.pop_back();
  // The last has a reciprocal vector that is the sum of one of each of two others.
  const auto dual = [&](int i) { return dual_of(scene.lattices[i].vectors, 2)[0]; };
  const Vec k = sum(dual(3), dual(19));
  const double k2 = dot(k, k);
  scene.lattices.back().vectors = {{{k[0] / k2, k[1] / k2, 0}, {-0.8123 * k[1], 0.8123 * k[0], 0}}};
  CHECK_FALSE(independent(scene));
}

TEST_CASE("Mean free path: by Santalo's formula where obstacles don't overlap", "[flights][mean]") {
  CHECK(mean_free_path_of(unit_scene(2, 0.2)).value == Approx((1 - kPi * 0.04) / 0.4).epsilon(1e-14));
  CHECK(mean_free_path_of(unit_scene(3, 0.3)).value ==
        Approx((1 - 4 * kPi * 0.027 / 3) / (kPi * 0.09)).epsilon(1e-14));
  const auto scenes = test::all_scenes();
  for (const char* name : {"overlapping", "overlapping-3d"}) {
    const MeanFreePath mean = mean_free_path_of(scenes.at(name));
    CHECK_FALSE(mean.value);
    CHECK(mean.how.find("overlap") != std::string::npos);
  }
  // Two lattices that keep step: no overlap, so plain Santalo; then with one.
  Scene two = turned_squares(0.2, {0, 0});
  two.lattices[1].atoms[0].position = {0.5, 0.5, 0};
  CHECK(mean_free_path_of(two).value == Approx(kPi * (1 - 2 * kPi * 0.04) / (2 * kPi * 0.4)).epsilon(1e-14));
  two = test::with_radius(two, 0.4);
  CHECK_FALSE(mean_free_path_of(two).value);
}

namespace {

// Is the point inside an obstacle of this lattice, which has one of at most half a cell each way?
bool is_shut(const Lattice& lattice, const Vec& x) {
  const Atom& atom = lattice.atoms[0];
  const Vec y = sum(x, scaled(atom.position, -1)), n = coordinates(dual_of(lattice.vectors, 2), y);
  const auto shape = dual_of(semiaxes_of(atom, 2), 2);
  for (int i = -1; i <= 1; ++i)
    for (int k = -1; k <= 1; ++k) {
      const Vec z = coordinates(shape, sum(y, sum(scaled(lattice.vectors[0], i - std::round(n[0])),
                                                  scaled(lattice.vectors[1], k - std::round(n[1])))));
      if (z[0] * z[0] + z[1] * z[1] < 1) return true;
    }
  return false;
}

constexpr std::size_t kNone = 99;

bool is_free(const Scene& scene, const Vec& x, std::size_t but = kNone) {
  for (std::size_t l = 0; l < scene.lattices.size(); ++l)
    if (l != but && is_shut(scene.lattices[l], x)) return false;
  return true;
}

struct Counted {
  double value, error2;
};

constexpr int kPoints = 400'000;

Counted free_share(const Scene& scene, cases::Random& random) {
  int free_points = 0;
  for (int i = 0; i < kPoints; ++i)
    free_points += is_free(scene, {random.between(-1e5, 1e5), random.between(-1e5, 1e5), 0});
  const double share = static_cast<double>(free_points) / kPoints;
  return {share, share * (1 - share) / kPoints};
}

// The perimeter of one lattice's obstacles, a cell, that the others leave free.
Counted free_surface(const Scene& scene, std::size_t l, cases::Random& random) {
  const Lattice& lattice = scene.lattices[l];
  const auto axes = semiaxes_of(lattice.atoms[0], 2);
  double length = 0, length2 = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * kPi * random.uniform(), c = std::cos(angle), s = std::sin(angle);
    Vec x = sum(lattice.atoms[0].position, sum(scaled(axes[0], c), scaled(axes[1], s)));
    for (int k = 0; k < 2; ++k)
      x = sum(x, scaled(lattice.vectors[k], static_cast<double>(random.integer(-100'000, 100'000))));
    const Vec along = sum(scaled(axes[0], -s), scaled(axes[1], c));
    const double weight = is_free(scene, x, l) ? 2 * kPi * std::sqrt(dot(along, along)) : 0;
    length += weight;
    length2 += weight * weight;
  }
  length /= kPoints;
  return {length, (length2 / kPoints - length * length) / kPoints};
}

}  // namespace

TEST_CASE("Mean free path: superposed lattices, by counting what is free", "[flights][mean]") {
  Scene scene = turned_squares(0.2, {0, kPi / 5, kPi / 7});  // cells of area 1
  scene.lattices[1].atoms[0].radius = 0.3;
  scene.lattices[2].atoms[0] = {{0.1, 0.3, 0}, 0, {{0.4, 0, 0}, {0, 0.1, 0}}};
  const MeanFreePath mean = mean_free_path_of(scene);
  REQUIRE(mean.value);
  cases::Random random(20261122, "superposed", 0);
  const Counted share = free_share(scene, random);
  Counted surface{0, 0};
  for (std::size_t l = 0; l < 3; ++l) {
    const Counted part = free_surface(scene, l, random);
    surface = {surface.value + part.value, surface.error2 + part.error2};
  }
  const double counted = kPi * share.value / surface.value,
               error = counted * std::sqrt(share.error2 / (share.value * share.value) +
                                           surface.error2 / (surface.value * surface.value));
  INFO(counted << " +- " << error << ", formula " << *mean.value);
  CHECK(error < 0.003 * counted);
  CHECK(std::fabs(counted - *mean.value) < 4 * error);
}

TEST_CASE("Tails: the sum over corridors is the oracle's", "[flights][tails]") {
  const auto square = [](double r) { return *corridor_tail_constant(unit_scene(2, r).lattices[0]); };
  CHECK(square(0.4) == Approx(0.0512014).epsilon(1e-5));
  CHECK(square(0.2) == Approx(0.366498).epsilon(1e-5));
  CHECK(square(0.1) == Approx(0.933643).epsilon(1e-5));
  CHECK(square(0.5) == 0);
  // Oblique cells, not reduced; the seed is 6.
  test::Draw draw(6);
  int corridors = 0;
  for (int i = 0; i < 60; ++i) {
    Scene scene = test::one_atom(2, {draw.vec(2, -2, 2), draw.vec(2, -2, 2)}, 0.04);
    if (cell_volume(scene.lattices[0], 2) < 0.3) continue;
    const auto horizon = oracle::horizon_of(scene);
    if (!horizon.tail_constant) continue;
    ++corridors;
    CHECK(*corridor_tail_constant(scene.lattices[0]) == Approx(*horizon.tail_constant).epsilon(1e-9));
  }
  CHECK(corridors > 30);  // 50 seen
}

TEST_CASE("Tails: the limit of the sum over corridors is the limit law's", "[flights][tails]") {
  const Scene small = test::one_atom(2, {{{1, 0, 0}, {0.3, 0.8, 0}}}, 0.0005);
  const double limit = *tail_when(tails_of(small, Ensemble::uniform), "r -> 0")->constant;
  CHECK(limit == Approx(0.8 / (kPi * kPi * 0.0005)));
  bool of_limit = false;
  CHECK(*corridor_tail_constant(small.lattices[0], &of_limit) == Approx(limit).epsilon(1e-5));
  CHECK_FALSE(of_limit);
  CHECK(*corridor_tail_constant(unit_scene(2, 1e-4).lattices[0], &of_limit) == Approx(1e4 / (kPi * kPi)));
  CHECK(of_limit);
  CHECK_FALSE(corridor_tail_constant(test::one_atom(2, {{{1e-3, 0, 0}, {0, 1e3, 0}}}, 1e-4).lattices[0]));
}

TEST_CASE("Tails: exponents and constants", "[flights][tails]") {
  const Scene three = turned_squares(1e-4, {0, kPi / 5, kPi / 7}), disc = unit_scene(2, 0.2),
              ball = unit_scene(3, 0.2);
  for (const auto ensemble : {Ensemble::uniform, Ensemble::surface}) {
    const double more = ensemble == Ensemble::surface;
    CHECK(tail_when(tails_of(three, ensemble), "r -> 0")->exponent == 4 + more);
    CHECK_FALSE(tail_when(tails_of(three, ensemble), "t -> infinity")->exponent);
    CHECK(tail_when(tails_of(disc, ensemble), "t -> infinity")->exponent == 2 + more);
    CHECK(tail_when(tails_of(ball, ensemble), "r -> 0")->exponent == 2 + more);
    CHECK(tail_when(tails_of(ball, ensemble), "t -> infinity")->exponent == 2 + more);
    // The limit's tail is that of the law.
    const Law law = *law_of(three, ensemble);
    const double t = 1e9, power = 3 + more;
    CHECK(*tail_when(tails_of(three, ensemble), "r -> 0")->constant ==
          Approx(law.survival(t) * std::pow(t, power)).epsilon(1e-4));
  }
  CHECK(*tail_when(tails_of(disc, Ensemble::uniform), "t -> infinity")->constant ==
        Approx(0.366498).epsilon(1e-5));
  CHECK(*tail_when(tails_of(disc, Ensemble::surface), "t -> infinity")->constant ==
        Approx(0.366498 * (1 - kPi * 0.04) / 0.4).epsilon(1e-5));
  CHECK(*tail_when(tails_of(ball, Ensemble::uniform), "t -> infinity")->constant ==
        Approx(1.117453).epsilon(1e-5));
  // Small balls: the sum over planes comes near to its limit.
  const auto small = tails_of(unit_scene(3, 0.02), Ensemble::uniform);
  CHECK(*tail_when(small, "t -> infinity")->constant ==
        Approx(*tail_when(small, "r -> 0")->constant).epsilon(1e-3));
  CHECK(tail_when(tails_of(unit_scene(2, 0.5), Ensemble::uniform), "t -> infinity")->remark ==
        "none: every path ends");
  CHECK_FALSE(tail_when(tails_of(unit_scene(2, 0.6), Ensemble::uniform), "t -> infinity")->exponent);
}

namespace {

// Two lattices of discs, of which the second has these vectors.
Scene with_second(const Scene& first, std::array<Vec, 3> vectors, Vec position = {}) {
  Scene scene = first;
  Lattice second = scene.lattices[0];
  second.vectors = vectors;
  second.atoms[0].position = position;
  scene.lattices.push_back(second);
  return scene;
}

}  // namespace

TEST_CASE("Tails: of a superposition what the horizon says", "[flights][tails]") {
  const Scene square = unit_scene(2, 0.1), cubic = unit_scene(3, 0.1);
  const double two = std::sqrt(2.0), three = std::sqrt(3.0);
  struct Asked {
    std::string name;
    Scene scene;
    std::optional<bool> open;
  };
  std::vector<Asked> all{
      {"the same axes, decimals", with_second(square, {{{1.414, 0, 0}, {0, 1.732, 0}}}), true},
      {"the same axes, roots", with_second(square, {{{two, 0, 0}, {0, three, 0}}}), true},
      {"in a skewed basis", with_second(square, {{{two, 0, 0}, {5 * two, three, 0}}}), true},
      {"of one direction alone", with_second(square, {{{two, 0, 0}, {0.3, three, 0}}}), true},
      {"of the diagonal alone", with_second(square, {{{1.375, 1.375, 0}, {0.1, 1.3, 0}}}), true},
      {"commensurable, out of step", with_second(square, {{{1, 0, 0}, {0, 1, 0}}}, {0.5, 0.5, 0}), true},
      {"commensurable, large", with_second(unit_scene(2, 0.36), {{{1, 0, 0}, {0, 1, 0}}}, {0.5, 0.5, 0}),
       false},
      {"turned by pi/5", turned_squares(0.1, {0, kPi / 5}), false},
      {"layers, in space", with_second(cubic, {{{two, 0, 0}, {0.2, three, 0}, {0, 0, 1}}}), true},
      {"layers at another distance", with_second(cubic, {{{two, 0, 0}, {0.2, three, 0}, {0, 0, two}}}), true},
      {"skewed, in space", with_second(cubic, {{{two, 0, 0}, {0.2, three, 0.1}, {0.3, 0.2, two}}}), false}};
  Scene ellipses = all[1].scene;
  ellipses.lattices[1].atoms[0] = {{}, 0, {{0.3, 0.01, 0}, {0, 0.05, 0}}};
  all.push_back({"ellipses", ellipses, true});
  ellipses.lattices[1].atoms[0].semiaxes = {{{0.9, 0, 0}, {0, 0.9, 0}}};
  all.push_back({"ellipses that overlap", ellipses, false});
  Scene overlapping = square;
  overlapping.lattices[0].atoms.push_back({{0.05, 0, 0}, 0.1, {}});
  all.push_back({"overlaps", overlapping, true});
  Scene third = all[1].scene;
  third.lattices.push_back(with_second(square, {{{kPi, 0, 0}, {0, kPi / 2, 0}}}).lattices[1]);
  all.push_back({"three, long common periods", third, std::nullopt});
  all.push_back({"small, turned by pi/5", turned_squares(1e-5, {0, kPi / 5}), false});
  all.push_back({"too small to be searched", turned_squares(1e-12, {0, kPi / 5}), std::nullopt});
  all.push_back({"too small, in step",
                 with_second(unit_scene(2, 1e-5), {{{1, 0, 0}, {0, 1, 0}}}, {0.5, 0.5, 0}), true});
  all.push_back({"too small, the same axes", test::with_radius(all[1].scene, 1e-5), true});
  for (const auto& [name, scene, open] : all) {
    INFO(name);
    const Tail uniform = tail_of_long_paths(scene, Ensemble::uniform),
               surface = tail_of_long_paths(scene, Ensemble::surface);
    INFO(uniform.remark);
    CHECK(uniform.open == open);
    CHECK(surface.open == open);
    CHECK(uniform.exponent == (open == true ? std::optional(2.0) : std::nullopt));
    CHECK(surface.exponent == (open == true ? std::optional(3.0) : std::nullopt));
    CHECK((uniform.remark.find("not known whether") != std::string::npos) == !open.has_value());
    CHECK(uniform.remark.find("incommensurate") == std::string::npos);
    if (open == true) {  // the remark says why the constant is not known
      CHECK_FALSE(uniform.constant);
      CHECK(uniform.remark.find("the constant is not known (") != std::string::npos);
    }
    CHECK(tails_of(scene, Ensemble::uniform).back().remark == uniform.remark);
  }
}

TEST_CASE("Tails: lattices that share a direction, turned by rounded numbers", "[flights][tails]") {
  const auto second = [](const Scene& first, std::array<Vec, 3> vectors) {
    Scene scene = with_second(first, vectors);
    for (Lattice& lattice : scene.lattices) lattice = turned(lattice, 0.3);
    return scene;
  };
  const double two = std::sqrt(2.0), three = std::sqrt(3.0);
  for (const Scene& scene : {second(unit_scene(2, 0.1), {{{two, 0, 0}, {0, three, 0}}}),
                             second(unit_scene(2, 0.1), {{{two, 0, 0}, {5 * two + 0.3, three, 0}}}),
                             second(unit_scene(2, 0.1), {{{2 * two, two, 0}, {0.1, three, 0}}}),
                             turned_squares(0.01, {0, std::atan(0.75)}),
                             second(unit_scene(3, 0.1), {{{two, 0, 0}, {0.2, three, 0.1}, {0, 0.4, two}}})}) {
    REQUIRE_FALSE(oracle::horizon_of(scene, 0, false).is_infinite());
    const Tail tail = tail_of_long_paths(scene, Ensemble::uniform);
    INFO(tail.remark);
    CHECK_FALSE(tail.open);
    CHECK(tail.remark.find("radians") != std::string::npos);
  }
  CHECK(tail_of_long_paths(second(unit_scene(2, 0.1), {{{1.4, 0.3, 0}, {-0.2, 1.7, 0}}}), Ensemble::uniform)
            .open == false);
  // Obstacles that leave no way of their own lattice open.
  CHECK(tail_of_long_paths(second(unit_scene(2, 0.45), {{{two, two, 0}, {0.1, 1.3, 0}}}), Ensemble::uniform)
            .open == false);
}

TEST_CASE("Tails: of small ellipses by the mean of their widths across all directions", "[flights][tails]") {
  // The mean of 1 / width is 1 / 2 M, M the arithmetic-geometric mean of the semiaxes a and b: M = r of a
  // disc.
  const double a = 0.0005, b = 0.0002;
  double m = a, g = b;
  for (int i = 0; i < 8; ++i) std::tie(m, g) = std::pair((m + g) / 2, std::sqrt(m * g));
  Scene scene = test::one_atom(2, {{{1, 0, 0}, {0.3, 0.8, 0}}}, a);
  scene.lattices[0].atoms[0] = {{}, 0, {{0.6 * a, 0.8 * a, 0}, {-0.8 * b, 0.6 * b, 0}}};
  const auto constant = [&](Ensemble ensemble) {
    return *tail_when(tails_of(scene, ensemble), "r -> 0")->constant;
  };
  const double one = 0.8 / (kPi * kPi * m), mean = kPi * 0.8 / surface_of(scene.lattices[0].atoms[0], 2);
  CHECK(constant(Ensemble::uniform) == Approx(one).epsilon(1e-9));
  CHECK(constant(Ensemble::surface) == Approx(one * mean).epsilon(1e-9));
  // Beside discs, which have one width.
  scene.lattices.push_back(turned(unit_scene(2, 0.001).lattices[0], kPi / 5));
  CHECK(constant(Ensemble::uniform) == Approx(one / (kPi * kPi * 0.001)).epsilon(1e-9));
}

TEST_CASE("Tails: constants are lengths, and none is given where the mean is beyond binary64",
          "[flights][tails]") {
  const auto ball = [](double scale) {
    return test::one_atom(3, {{{scale, 0, 0}, {0, scale, 0}, {0, 0, scale}}}, 0.25 * scale);
  };
  for (const char* when : {"r -> 0", "t -> infinity"})
    for (const auto ensemble : {Ensemble::uniform, Ensemble::surface}) {
      INFO(when);
      const double length = ensemble == Ensemble::uniform ? 4 : 16;  // the power of t
      CHECK(*tail_when(tails_of(ball(4), ensemble), when)->constant ==
            Approx(length * *tail_when(tails_of(ball(1), ensemble), when)->constant));
    }
  const Scene huge = ball(0x1p1023);
  CHECK(tail_of_long_paths(huge, Ensemble::uniform).constant);
  const Tail surface = tail_of_long_paths(huge, Ensemble::surface);
  CHECK_FALSE(surface.constant);
  CHECK(surface.exponent == 3.0);
  CHECK(surface.remark.find("the mean free path is not known") != std::string::npos);
}

TEST_CASE("Tails: one lattice of discs, by the sum or the search", "[flights][tails]") {
  // A corridor of width 2^-60, and touching discs; the sum in binary64 has no place for such a width.
  const Scene touching = unit_scene(2, 0.5);
  CHECK(tail_of_long_paths(touching, Ensemble::uniform).open == false);
  const Scene tiny = test::one_atom(2, {{{0x1p-20, 0, 0}, {0, 0x1p-20, 0}}}, 0x1p-21);
  CHECK(tail_of_long_paths(tiny, Ensemble::uniform).open == false);
  Scene nearly = test::one_atom(2, {{{1, 0, 0}, {0, 1 + 0x1p-52, 0}}}, 0.5);
  CHECK(tail_of_long_paths(nearly, Ensemble::uniform).open == true);
  for (const double r : {0.3, 0.11, 0.09, 0.01}) {
    const Scene scene = test::one_atom(2, {{{1, 0, 0}, {0.3, 0.8, 0}}}, r);
    CHECK(tail_of_long_paths(scene, Ensemble::uniform).constant.value() ==
          Approx(*oracle::horizon_of(scene).tail_constant).epsilon(1e-9));
  }
  // Discs in a row that overlap: no area is free of them alone.
  const Scene rows = test::one_atom(2, {{{0.01, 0, 0}, {0, 100, 0}}}, 0.05);
  CHECK(tail_of_long_paths(rows, Ensemble::uniform).exponent == 2);
  CHECK_FALSE(tail_of_long_paths(rows, Ensemble::uniform).constant);
}

TEST_CASE("Ways between ellipses are those across which these are narrow", "[flights][laws]") {
  constexpr double kAngle = 1e-10;
  const auto nearly_common = [](const Atom& one, const Atom& other) {
    const Lattice first{{Vec{1, 0, 0}, Vec{0, 1, 0}}, {one}};
    const Lattice second{{Vec{1, kAngle, 0}, Vec{-kAngle, 1, 0}}, {other}};
    return nearly_common_way({2, {first, second}});
  };
  const Atom upright{{}, 0, {Vec{0.1, 0, 0}, Vec{0, 0.6, 0}}}, lying{{}, 0, {Vec{0.6, 0, 0}, Vec{0, 0.1, 0}}};
  const Atom tilted{{}, 0, {Vec{0.05, 0.6, 0}, Vec{0.05, 0, 0}}};  // upright; its rows' would be lying
  CHECK(nearly_common(lying, lying).value_or(0) == Approx(kAngle).epsilon(1e-4));
  for (const Atom& one : {upright, tilted}) {
    CHECK(nearly_common(one, upright).value_or(0) == Approx(kAngle).epsilon(1e-4));
    CHECK(nearly_common(upright, one).value_or(0) == Approx(kAngle).epsilon(1e-4));
    CHECK_FALSE(nearly_common(one, lying));
    CHECK_FALSE(nearly_common(lying, one));
  }
  // An atom of either kind shuts what the other leaves.
  const std::array<Vec, 3> square{Vec{1, 0, 0}, Vec{0, 1, 0}},
      turned_by{Vec{1, kAngle, 0}, Vec{-kAngle, 1, 0}};
  const Lattice both{square, {upright, lying}}, other_way{square, {lying, upright}};
  for (const Lattice& lattice : {both, other_way})
    for (const Atom& atom : {upright, lying})
      CHECK_FALSE(nearly_common_way({2, {lattice, {turned_by, {atom}}}}));
  // A third lattice that shuts the way, or leaves it open too.
  const Lattice one{square, {upright}}, second{turned_by, {upright}}, third{square, {lying}};
  CHECK(nearly_common_way({2, {one, second, one}}).value_or(0) == Approx(kAngle).epsilon(1e-4));
  for (const auto& lattices : {std::vector{one, second, third}, {one, third, second}, {third, one, second}})
    CHECK_FALSE(nearly_common_way({2, lattices}));
}

TEST_CASE("Ways that are nearly common at several angles: the least is named", "[flights][laws]") {
  const Lattice square = unit_scene(2, 0.4).lattices[0];
  for (const auto& [first, second] : {std::pair{1e-10, 3e-10}, {3e-10, 1e-10}}) {
    Lattice sheared = square;
    sheared.vectors = {Vec{1, first, 0}, Vec{-second, 1, 0}};
    CHECK(nearly_common_way({2, {square, sheared}}).value_or(0) == Approx(1e-10).epsilon(1e-4));
  }
}
