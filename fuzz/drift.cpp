// drift: flights in a channel between lattice planes that drift out of it, by the last bits of v or by a
// small slope, and start just out of a plane's reach. Who jumps to where the next plane comes within reach
// has to know which one it is: the sign of the drift, which is n . v for the planes' normal n, a sum whose
// terms cancel. Rounding alone leaves an n . v of 2^-53, of which binary64 knows the sign. One component 2^-k
// as large as the others has bits finer by as much: 2^k (n_0 V_0 + n_1 V_1) + n_2 V_2 = j in integers is
// solved by V_2 with n_2 V_2 = j modulo 2^k gcd(n_0, n_1), and Bezout's identity for the rest, and then n . v
// is j 2^-52-k.
//
// Once the line is within reach of a plane, the plane's section of the cylinder is as long as r over the
// slope, and the first of many obstacles is asked for in an ellipse as slender as the slope is small.
#include <cmath>

#include "crystals.hpp"
#include "dual.hpp"
#include "family_list.hpp"
#include "parts.hpp"

namespace lorentz::fuzz {
namespace {

// In the planes with the normal n, whose last component is odd and whose others are not both 0, but for n . v
// = j 2^-52-k.
Vec nearly_in_planes(Random& random, const IntVec& n, std::int64_t j, int k) {
  constexpr std::int64_t kLarge = std::int64_t{1} << 48;
  const IntVec u = bezout({n[0], n[1], 0});
  const std::int64_t g = content_of({n[0], n[1], 0}), step = g << k;
  std::int64_t V2 = random.integer(kLarge / 2, kLarge);
  while ((n[2] * V2 - j) % step != 0) ++V2;  // step numbers at most, since n_2 is prime to step
  const std::int64_t M = (j - n[2] * V2) / step, t = random.integer(kLarge, 2 * kLarge) * 2 + 1;
  const auto V0 = static_cast<double>(u[0] * M + t * (n[1] / g)),
             V1 = static_cast<double>(u[1] * M - t * (n[0] / g));
  return {std::ldexp(V0, -52), std::ldexp(V1, -52), std::ldexp(static_cast<double>(V2), -52 - k)};
}

// So that nearly_in_planes can be asked for it: a primitive vector has an odd component.
IntVec drawn_normal(Random& drawn) {
  IntVec n = drawn_primitive(drawn, 3, drawn.one_in(4) ? 12 : 2);
  while (n[2] % 2 == 0) n = {n[1], n[2], n[0]};
  if (n[0] == 0 && n[1] == 0) n[1] = 1;
  return n;
}

Case make_drift(Source& source) {
  Case made;
  Random &drawn = source.scene, &random = source.random;
  const bool unit = drawn.one_in(2);
  made.scene = unit ? unit_scene(3, 1) : drawn_crystal(drawn, 3).scene;
  const Lattice& lattice = made.scene.lattices[0];
  const IntVec n = drawn_normal(drawn);
  const auto [g1, g2] = across_of(n);
  const double half = half_width(lattice, 3, n);
  const double r = half * (drawn.one_in(2) ? drawn.between(0.05, 0.95) : drawn.octave(-6, -1));
  set_radius(made.scene, r);
  const Vec a = cartesian(lattice, g1), b = cartesian(lattice, g2), across = cross(a, b);
  Vec normal = scaled(across, 1 / length(across));
  if (unit && lorentz::dot(normal, to_vec(n)) < 0) normal = scaled(normal, -1);
  Vec v = sum(scaled(a, random.between(-1, 1)), scaled(b, random.between(0.1, 1)));
  const double side = random.sign();
  if (random.one_in(2)) {
    made.tags.push_back("by-slope");
    v = sum(v, scaled(normal, -side * length(v) * random.octave(-40, -4)));
  } else if (unit) {
    made.tags.push_back("by-bits");
    const auto k = static_cast<int>(random.integer(0, 8));
    v = nearly_in_planes(random, n, static_cast<std::int64_t>(-side) * random.integer(1, 4), k);
  } else {
    made.tags.push_back("by-rounding");
  }
  const double out = r + (half - r) * random.octave(-20, 0);
  made.query.x =
      sum(sum(scaled(a, random.uniform()), scaled(b, random.uniform())), scaled(normal, side * out));
  made.query.v = v;
  return made;
}

}  // namespace

Family drift() {
  return {"drift",
          "Flights between lattice planes that drift out of the channel, from just out of a plane's reach.",
          {{"by-bits", "towards the near plane, at a slope of 2^-60 to 2^-50"},
           {"by-rounding", "the velocity is in the planes but for its rounding"},
           {"by-slope", "towards the near plane, at a slope of 2^-40 to 2^-4"}},
          make_drift};
}

}  // namespace lorentz::fuzz
