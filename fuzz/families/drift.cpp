// drift: flights in a channel between lattice planes that drift out of it, by the last bits of v or by a
// small slope, and start just out of a plane's reach. An engine that jumps to where the next plane comes
// within reach has to know which plane that is. This depends on the sign of the drift v . N, with N the
// planes' normal: a sum whose terms cancel. Planes through (1, 0, P 2^-k) and (0, 1, Q 2^-k), P and Q odd,
// have N = (-P, -Q, 2^k). For integers V_0, V_1 with P V_0 + Q V_1 = -j modulo 2^k there is a V_2 with
// N . V = j. If these integers are about 2^50, the flight drifts by j 2^-50-k, less than binary64 can resolve
// in the sum.
//
// Once the line is within reach of a plane, the plane's section of the cylinder is as long as r over the
// slope. The first of many obstacles has to be found in an ellipse that is as slender as the slope is small.
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"

namespace lorentz::cases {
namespace {

// Lattice planes whose normal has k bits.
struct SlantedLayers {
  std::int64_t P, Q;
  int k;

  explicit SlantedLayers(Random& drawn) : k(drawn.exponent(4, 20)) {
    const std::int64_t half = std::int64_t{1} << (k - 1);
    P = drawn.integer(-half, half) | 1, Q = drawn.integer(-half, half) | 1;
  }
  Scene scene(double apart) const {
    const auto place = [&](std::int64_t a) { return std::ldexp(static_cast<double>(a), -k); };
    return lattice_scene(3, {Vec{1, 0, place(P)}, Vec{0, 1, place(Q)}, Vec{0, 0, apart}}, 1);
  }
  // In the layers, except that N . v = j 2^-50-k (in binary32 j 2^-21-k).
  Vec velocity(Random& random, NumberFormat precision, std::int64_t j) const {
    const int bits = bits_of(precision) - 3;
    const std::int64_t large = std::int64_t{1} << bits;
    const std::int64_t V0 = random.integer(-large, large);
    std::int64_t inverse =
        Q;  // of Q modulo 2^3, and after each of Newton's steps modulo the square of that power
    for (int step = 0; step < 3; ++step) inverse = (inverse * ((2 - Q * inverse) & low())) & low();
    const std::int64_t rest = (-j - P * (V0 & low())) & low();
    const std::int64_t V1 = (random.integer(-large, large) & ~low()) + ((rest * inverse) & low());
    const Wide V2 = (j + static_cast<Wide>(P) * V0 + static_cast<Wide>(Q) * V1) >> k;
    Vec v{static_cast<double>(V0), static_cast<double>(V1), static_cast<double>(V2)};
    return scaled(v, std::ldexp(1, -bits));
  }

 private:
  std::int64_t low() const { return (std::int64_t{1} << k) - 1; }
};

void make_drift(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const bool layers = drawn.one_in(2);
  const SlantedLayers drawn_layers(drawn);
  const IntVec n = layers ? IntVec{0, 0, 1} : drawn_primitive(drawn, 3, drawn.one_in(4) ? 12 : 2);
  made.scene = layers            ? drawn_layers.scene(drawn.between(1, 2))
               : drawn.one_in(2) ? unit_scene(3, 1)
                                 : drawn_crystal(drawn, 3).scene;
  const Lattice& lattice = made.scene.lattices[0];
  const auto [g1, g2] = across_of(n);
  const double half = half_width(lattice, 3, n);
  const double r = half * (drawn.one_in(2) ? drawn.between(0.05, 0.95) : drawn.octave(-6, -1));
  set_radius(made.scene, r);
  const Vec a = cartesian(lattice, g1), b = cartesian(lattice, g2), across = cross(a, b);
  const Vec normal = scaled(across, (across[2] < 0 ? -1 : 1) / length(across));
  const double side = random.sign();
  const double v_b = random.between(0.1, 1), v_a = random.between(-1, 1);
  made.query.v = sum(scaled(a, v_a), scaled(b, v_b));
  if (layers && !random.one_in(3)) {
    made.tags.push_back("by-bits");
    made.query.v = drawn_layers.velocity(random, source.precision,
                                         static_cast<std::int64_t>(-side) * random.integer(1, 4));
  } else if (random.one_in(2)) {
    made.tags.push_back("by-slope");
    const double slope = random.octave(source.is_wide() ? -40 : -20, -4) * length(made.query.v);
    made.query.v = plus(made.query.v, -side * slope, normal);
  } else {
    made.tags.push_back("by-rounding");
  }
  const double out = r + (half - r) * random.octave(source.is_wide() ? -20 : -16, random.one_in(2) ? 0 : -8);
  const double x_b = random.uniform(), x_a = random.uniform();
  made.query.x = plus(sum(scaled(a, x_a), scaled(b, x_b)), side * out, normal);
}

}  // namespace

Family drift() {
  return {"drift",
          "Flights between lattice planes that drift out of the channel, from just out of a plane's reach.",
          {{"by-bits", "towards the near plane, at a slope of 2^-70 to 2^-52"},
           {"by-rounding", "the velocity is in the planes but for its rounding"},
           {"by-slope", "towards the near plane, at a slope of 2^-40 to 2^-4"}},
          make_drift};
}

}  // namespace lorentz::cases
