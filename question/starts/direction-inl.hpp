// Isotropic directions from random words: one word for the circle, two for the sphere. Numbers are binary64, or
// have one in each lane of a vector: included once for single starts and once for each set of instructions.

/// (cos a, sin a) for |a| <= pi / 4, by the first terms of their series. The remainder is below 5e-17.
/// Library functions are not used, because their last bits differ from machine to machine.
template <class Number>
inline std::array<Number, 2> turned(Number a) {
  const Number s = a * a;
  Number sine = -1.0 / 1307674368000, cosine = 1.0 / 20922789888000;  // 15!, 16!
  sine = sine * s + 1.0 / 6227020800, cosine = cosine * s - 1.0 / 87178291200;
  sine = sine * s - 1.0 / 39916800, cosine = cosine * s + 1.0 / 479001600;
  sine = sine * s + 1.0 / 362880, cosine = cosine * s - 1.0 / 3628800;
  sine = sine * s - 1.0 / 5040, cosine = cosine * s + 1.0 / 40320;
  sine = sine * s + 1.0 / 120, cosine = cosine * s - 1.0 / 720;
  sine = sine * s - 1.0 / 6, cosine = cosine * s + 1.0 / 24;
  cosine = cosine * s - 0.5;
  return {cosine * s + 1.0, sine * s * a + a};
}

/// Uniform on the unit circle, up to rounding. Uses one word: two bits choose the quarter, the others the
/// place in it.
template <class Random>
[[gnu::always_inline]] inline auto on_circle(Random& random) {
  const auto bits = random.bits();
  const auto [cosine, sine] = turned((random.share_of(bits) - 0.5) * (std::numbers::pi / 2));
  const auto [c, s] = quarter_turn(bits);
  return std::array<decltype(random.uniform()), 3>{c * cosine - s * sine, c * sine + s * cosine, 0.0};
}

/// Uniform on the unit sphere, up to rounding. Uses two words: height and angle are independent (Archimedes).
template <class Random>
[[gnu::always_inline]] inline auto on_sphere(Random& random) {
  const auto height = 2.0 * random.uniform() - 1.0, width = sqrt((1.0 - height) * (1.0 + height));
  auto a = on_circle(random);
  return decltype(a){width * a[0], width * a[1], height};
}

/// Isotropic, of unit length up to rounding.
template <class Random>
inline auto direction(Random& random, int dimension) {
  return dimension == 2 ? on_circle(random) : on_sphere(random);
}
