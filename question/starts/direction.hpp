// Isotropic directions from random words: one word for the circle, two for the sphere.
#pragma once

#include <cmath>
#include <numbers>

#include "question/cases/random.hpp"

namespace lorentz::starts {

/// (cos a, sin a) for |a| <= pi / 4, by the first terms of their series. The remainder is below 5e-17.
/// Library functions are not used, because their last bits differ from machine to machine.
inline Vec turned(double a) {
  const double s = a * a;
  double sine = -1.0 / 1307674368000, cosine = 1.0 / 20922789888000;  // 15!, 16!
  sine = sine * s + 1.0 / 6227020800, cosine = cosine * s - 1.0 / 87178291200;
  sine = sine * s - 1.0 / 39916800, cosine = cosine * s + 1.0 / 479001600;
  sine = sine * s + 1.0 / 362880, cosine = cosine * s - 1.0 / 3628800;
  sine = sine * s - 1.0 / 5040, cosine = cosine * s + 1.0 / 40320;
  sine = sine * s + 1.0 / 120, cosine = cosine * s - 1.0 / 720;
  sine = sine * s - 1.0 / 6, cosine = cosine * s + 1.0 / 24;
  cosine = cosine * s - 0.5;
  return {cosine * s + 1, sine * s * a + a, 0};
}

/// Uniform on the unit circle, up to rounding. Uses one word: two bits choose the quarter, the others the
/// place in it.
inline Vec on_circle(cases::Random& random) {
  constexpr double kCosine[] = {1, 0, -1, 0}, kSine[] = {0, 1, 0, -1};
  const std::uint64_t bits = random.bits();
  const double quarters = static_cast<double>(bits >> 11) * 0x1p-53 - 0.5;
  const Vec a = turned(quarters * (std::numbers::pi / 2));
  const double c = kCosine[bits & 3], s = kSine[bits & 3];
  return {c * a[0] - s * a[1], c * a[1] + s * a[0], 0};
}

/// Uniform on the unit sphere, up to rounding. Uses two words: height and angle are independent (Archimedes).
inline Vec on_sphere(cases::Random& random) {
  const double height = 2 * random.uniform() - 1, width = std::sqrt((1 - height) * (1 + height));
  const Vec a = on_circle(random);
  return {width * a[0], width * a[1], height};
}

/// Isotropic, of unit length up to rounding.
inline Vec direction(cases::Random& random, int dimension) {
  return dimension == 2 ? on_circle(random) : on_sphere(random);
}

}  // namespace lorentz::starts
