#include "statistics/chaos/theory.hpp"

#include <cmath>
#include <numbers>

#include <lorentz/geometry.hpp>
#include "src/problem/scene_geometry.hpp"
#include "statistics/theory/small_obstacles.hpp"

namespace lorentz::chaos {

using flights::only_ball;

namespace {

constexpr double kPi = std::numbers::pi, kZeta3 = 1.2020569031595942854;

}  // namespace

std::optional<double> exponent_of_small_discs(const Scene& scene) {
  const Atom* disc = only_ball(scene, 2);
  if (!disc) return std::nullopt;
  constexpr double kConstant = 1 - 4 * std::numbers::ln2 + 27 * kZeta3 / (2 * kPi * kPi);
  return std::log(cell_volume(scene.lattices[0], 2)) - 2 * std::log(disc->radius) + kConstant;
}

std::optional<double> exponents_of_small_balls(const Scene& scene) {
  const Atom* ball = only_ball(scene, 3);
  if (!ball) return std::nullopt;
  constexpr double kMeanLogarithm = -1.6857;
  return 2 * std::log(cell_volume(scene.lattices[0], 3)) - 6 * std::log(ball->radius) +
         2 * std::numbers::ln2 + 2 * kMeanLogarithm;
}

// A particle leaves the trap between three discs, which has the area F, through one of three gaps of width w
// at the rate 3 w / (pi F). The centre of the next trap is s / sqrt(3) away, where s is the spacing. Hence D
// = rate s^2 / 12.
std::optional<double> machta_zwanzig(const Scene& scene) {
  const Atom* disc = only_ball(scene, 2);
  if (!disc) return std::nullopt;
  const auto u = with_short_vectors(scene.lattices[0], 2).vectors;
  const double square = dot(u[0], u[0]), cosine = dot(u[0], u[1]) / square;
  const bool triangular =
      std::fabs(dot(u[1], u[1]) / square - 1) < 1e-12 && std::fabs(std::fabs(cosine) - 0.5) < 1e-12;
  const double spacing = std::sqrt(square), gap = spacing - 2 * disc->radius;
  if (!triangular || gap < 0) return std::nullopt;
  const double area = (std::sqrt(0.75) * square - kPi * disc->radius * disc->radius) / 2;
  return 3 * gap / (kPi * area) * square / 12;
}

}  // namespace lorentz::chaos
