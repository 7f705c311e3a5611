// drift: flights in a channel between lattice planes that drift out of it, by the rounding of v alone or by a
// small slope, and start just out of the planes' reach. Who jumps to where the next plane comes within reach
// has to know which one it is: the sign of the drift, which is v . n for the planes' normal n, a sum whose
// terms cancel. Once the line is within reach of a plane the plane's section of the cylinder is r long over
// the slope, and the first of many obstacles is asked for in an ellipse as slender as the slope is small.
#include <cmath>

#include "crystals.hpp"
#include "family_list.hpp"
#include "parts.hpp"

namespace lorentz::fuzz {
namespace {

Case make_drift(Source& source) {
  Case made;
  Random &drawn = source.scene, &random = source.random;
  made.scene = drawn.one_in(2) ? unit_scene(3, 1) : drawn_crystal(drawn, 3).scene;
  const Lattice& lattice = made.scene.lattices[0];
  const IntVec n = drawn_primitive(drawn, 3, drawn.one_in(4) ? 12 : 2);
  const auto [g1, g2] = across_of(n);
  const double half = half_width(lattice, 3, n);
  const double r = half * (drawn.one_in(2) ? drawn.between(0.05, 0.95) : drawn.octave(-6, -1));
  set_radius(made.scene, r);
  const Vec a = cartesian(lattice, g1), b = cartesian(lattice, g2), across = cross(a, b);
  const Vec normal = scaled(across, 1 / length(across));
  Vec v = sum(scaled(a, random.between(-1, 1)), scaled(b, random.between(0.1, 1)));
  const double side = random.sign();
  if (random.one_in(2)) {
    made.tags.push_back("by-rounding");
  } else {
    made.tags.push_back("by-slope");
    v = sum(v, scaled(normal, -side * length(v) * random.octave(-40, -4)));
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
          {{"by-rounding", "the velocity is in the planes but for its rounding"},
           {"by-slope", "towards the near plane, at a slope of 2^-40 to 2^-4"}},
          make_drift};
}

}  // namespace lorentz::fuzz
