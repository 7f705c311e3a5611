// Volumes, surfaces, mean free paths: against closed forms, and against quadrature.
#include "src/problem/scene_geometry.hpp"
#include <lorentz/geometry.hpp>

#include <catch2/catch.hpp>

#include <numbers>

#include "question/cases/random.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using lorentz::test::Draw;
using std::numbers::pi;

namespace {

Atom with_axes(std::vector<Vec> axes) {
  return {{}, 0, std::move(axes)};
}

// An ellipsoid of these semiaxes, turned anyhow, and described by three vectors that are not principal axes.
Atom disguised(Draw& draw, const Vec& axes) {
  cases::Random random(1, "frames", draw.below(1'000'000'000));
  std::array<Vec, 3> turn, mix;
  for (auto* frame : {&turn, &mix}) {
    const Vec e = random.direction(3), f = random.direction(3);
    Vec g = cross(e, f);
    const double length = std::sqrt(dot(g, g));
    for (double& component : g) component /= length;
    *frame = {e, g, cross(e, g)};
  }
  std::vector<Vec> columns(3);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      for (int m = 0; m < 3; ++m) columns[static_cast<std::size_t>(i)][k] += turn[m][k] * axes[m] * mix[m][i];
  return with_axes(columns);
}

// The surface by the midpoint rule, which converges fast for periodic functions, in both angles.
double surface_by_quadrature(double a, double b, double c) {
  constexpr int kSteps = 1000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double theta = pi * (i + 0.5) / kSteps, st = std::sin(theta), ct = std::cos(theta);
    for (int k = 0; k < kSteps; ++k) {
      const double phi = 2 * pi * (k + 0.5) / kSteps;
      sum += st * std::hypot(b * c * st * std::cos(phi), a * c * st * std::sin(phi), a * b * ct);
    }
  }
  return sum * (pi / kSteps) * (2 * pi / kSteps);
}

}  // namespace

TEST_CASE("Discs, spheres and ellipses", "[problem][scene_geometry]") {
  CHECK(volume_of({{}, 0.3, {}}, 2) == Approx(pi * 0.09).epsilon(1e-15));
  CHECK(surface_of({{}, 0.3, {}}, 2) == Approx(2 * pi * 0.3).epsilon(1e-15));
  CHECK(volume_of({{}, 0.3, {}}, 3) == Approx(4 * pi / 3 * 0.027).epsilon(1e-15));
  CHECK(surface_of({{}, 0.3, {}}, 3) == Approx(4 * pi * 0.09).epsilon(1e-14));
  // Semiaxes 2 and 1: E(k) at k^2 = 3/4 (DLMF 19.2.8).
  const Atom ellipse = with_axes({{1.2, 1.6, 0}, {-0.8, 0.6, 0}});
  CHECK(volume_of(ellipse, 2) == Approx(2 * pi).epsilon(1e-15));
  CHECK(surface_of(ellipse, 2) == Approx(9.688448220547675).epsilon(1e-14));
  CHECK(surface_of(with_axes({{1, 0, 0}, {0, 1e-9, 0}}), 2) == Approx(4).epsilon(1e-14));
}

TEST_CASE("Spheroids, from needles to plates, and nearly spheres", "[problem][scene_geometry]") {
  for (const double ratio : {1e-8, 1e-3, 0.3, 0.9, 0.999, 1 - 1e-6, 1 - 1e-12}) {
    INFO("ratio " << ratio);
    const double e = std::sqrt((1 - ratio) * (1 + ratio));
    // asin(e)/e = acos(ratio)/e and atanh(e)/e by their series where e is small.
    const double asin_e = e > 1e-2 ? std::acos(ratio) / e : 1 + e * e / 6 + 3 * e * e * e * e / 40;
    const double atanh_e = e > 1e-2 ? std::log((1 + e) / ratio) / e : 1 + e * e / 3 + e * e * e * e / 5;
    const double prolate = 2 * pi * ratio * (ratio + asin_e), oblate = 2 * pi * (1 + ratio * ratio * atanh_e);
    CHECK(surface_of(with_axes({{1, 0, 0}, {0, ratio, 0}, {0, 0, ratio}}), 3) ==
          Approx(prolate).epsilon(1e-11));
    CHECK(surface_of(with_axes({{ratio, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 3) == Approx(oblate).epsilon(1e-11));
  }
}

TEST_CASE("General ellipsoids: principal axes from any description, the surface by quadrature",
          "[problem][scene_geometry]") {
  Draw draw(71);
  for (int n = 0; n < 20; ++n) {
    Vec axes{draw.between(0.05, 1), draw.between(0.05, 1), draw.between(0.05, 1)};
    const Atom atom = disguised(draw, axes);
    const double surface = surface_by_quadrature(axes[0], axes[1], axes[2]);
    CHECK(surface_of(atom, 3) == Approx(surface).epsilon(1e-5));
    CHECK(volume_of(atom, 3) == Approx(4 * pi / 3 * axes[0] * axes[1] * axes[2]).epsilon(1e-13));
    std::sort(axes.rbegin(), axes.rend());
    const auto found = principal_semiaxes(atom, 3);
    for (int k = 0; k < 3; ++k) CHECK(found[k] == Approx(axes[k]).epsilon(1e-13));
  }
}

TEST_CASE("Filling and mean free path: the square and the cubic gas, motifs, superpositions",
          "[problem][scene_geometry]") {
  for (const double r : {0.001, 0.1, 0.4, 0.5}) {
    const Filling square = *filling_of(unit_scene(2, r)), cubic = *filling_of(unit_scene(3, r));
    CHECK(square.fraction == Approx(pi * r * r).epsilon(1e-14));
    CHECK(square.mean_free_path == Approx((1 - pi * r * r) / (2 * r)).epsilon(1e-13));
    CHECK(cubic.fraction == Approx(4 * pi / 3 * r * r * r).epsilon(1e-14));
    CHECK(cubic.mean_free_path == Approx((1 - 4 * pi / 3 * r * r * r) / (pi * r * r)).epsilon(1e-13));
  }
  // The same obstacles as a motif, and as two lattices.
  Scene motif = unit_scene(3, 0.3), two = motif;
  motif.lattices[0].atoms.push_back({{0.5, 0.5, 0.5}, 0.2, {}});
  two.lattices.push_back(two.lattices[0]);
  two.lattices[1].atoms[0] = {{0.5, 0.5, 0.5}, 0.2, {}};
  CHECK(filling_of(two)->mean_free_path == Approx(filling_of(motif)->mean_free_path).epsilon(1e-14));
  CHECK(filling_of(motif)->fraction == Approx(4 * pi / 3 * (0.027 + 0.008)).epsilon(1e-14));
}

TEST_CASE("Filling does not depend on the unit of length, up to the ends of binary64",
          "[problem][scene_geometry]") {
  for (const int exponent : {-1000, -530, 530, 1000}) {
    const auto filling = filling_of(scaled(unit_scene(2, 0.125), exponent));
    REQUIRE(filling.has_value());
    CHECK(filling->fraction == filling_of(unit_scene(2, 0.125))->fraction);
    CHECK(filling->mean_free_path == std::scalbn(filling_of(unit_scene(2, 0.125))->mean_free_path, exponent));
  }
  Scene oblique = unit_scene(3, 1);
  oblique.lattices[0].vectors[0] = {0.3, 0.1, 0.2};
  oblique.lattices[0].atoms[0] = with_axes({{0.3, 0, 0}, {0.3, 0.003, 0}, {0.1, 0.2, 0.1}});
  for (const int exponent : {-1000, -600, 600, 1000}) {
    const Scene other = scaled(oblique, exponent);
    const auto axes = principal_semiaxes(oblique.lattices[0].atoms[0], 3);
    for (int i = 0; i < 3; ++i)
      CHECK(principal_semiaxes(other.lattices[0].atoms[0], 3)[i] == std::scalbn(axes[i], exponent));
    CHECK(shortest_vector(other) == std::scalbn(shortest_vector(oblique), exponent));
  }
  Scene needle = unit_scene(3, 1);
  needle.lattices[0].atoms[0] = {{}, 0, {Vec{0.1, 0, 0}, Vec{0, 1e-170, 0}, Vec{0, 0, 1e-170}}};
  CHECK_FALSE(filling_of(needle).has_value());
  const auto axes = [&](const Vec& a, const Vec& b, const Vec& c) {
    needle.lattices[0].atoms[0].semiaxes = {a, b, c};
    return principal_semiaxes(needle.lattices[0].atoms[0], 3);
  };
  CHECK(axes({1e130, 0, 0}, {0, 1e-170, 0}, {0, 0, 1e-160}) == std::array{1e130, 1e-160, 1e-170});
  const auto skew = axes({1e160, 0, 0}, {1e-100, 1e-100, 0}, {0, 0, 1e-100}),
             flat = axes({1e160, 0, 0}, {1e160, 1e160, 0}, {0, 0, 1e-160});
  for (int i = 1; i < 3; ++i) CHECK(skew[i] == Approx(1e-100).epsilon(1e-12));
  CHECK(flat[0] * 1e-160 == Approx((std::sqrt(5) + 1) / 2));
  CHECK(flat[1] * 1e-160 == Approx((std::sqrt(5) - 1) / 2));
}

TEST_CASE("Dual vectors of lengths far apart, whichever is the shortest", "[problem][scene_geometry]") {
  for (const int dimension : {2, 3})
    for (const int longest : {0, 600})
      for (int shortest = 0; shortest < dimension; ++shortest) {
        std::array<Vec, 3> vectors{};
        for (int i = 0; i < dimension; ++i)
          vectors[i][i] = std::ldexp(1, i == shortest ? longest - 600 : longest);
        const std::array<Vec, 3> dual = dual_of(vectors, dimension);
        for (int i = 0; i < dimension; ++i)
          for (int k = 0; k < 3; ++k) CHECK(dual[i][k] == (i == k ? 1 / vectors[i][i] : 0));
      }
}
