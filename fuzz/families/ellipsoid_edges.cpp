// ellipsoid-edges: starts on the surface of slender tilted ellipsoids, and lines that touch them along their
// length from nearby. In the metric in which an ellipsoid is a ball, the terms of a velocity along its length
// cancel except for its slenderness, here 2^-6 to 2^-10, and the digits are lost with them: the error is a
// roundoff of the length, not of the width. A line given in binary64 misses its tangent by about as much.
//
// With A the semiaxes, v = A w and a unit vector n at a right angle to w, the line through p + A n along v
// touches the ellipsoid { p + A y : |y| < 1 }.

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/scenes.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {
namespace {

// Semiaxes at right angles; the first is the longest, and at most 0.3 long, so that a start beyond its end is
// near.
std::vector<Vec> drawn_semiaxes(Random& drawn, int dimension) {
  const double longest = drawn.between(0.1, 0.3), slender = drawn.octave(-10, -6);
  const auto [along, across, upright] = drawn_frame(drawn, drawn.direction(dimension), dimension);
  std::vector<Vec> semiaxes{scaled(along, longest), scaled(across, longest * slender)};
  if (dimension == 2) return semiaxes;
  const double third = drawn.one_in(2) ? slender : drawn.between(slender, 1);
  semiaxes.push_back(scaled(upright, longest * third));
  return semiaxes;
}

void make_edge(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const int dimension = drawn.one_in(2) ? 3 : 2;
  const std::vector<Vec> semiaxes = drawn_semiaxes(drawn, dimension);
  made.scene = unit_scene(dimension, 1);
  Atom& atom = made.scene.lattices[0].atoms[0];
  atom = {{}, 0, semiaxes};
  if (drawn.one_in(4))
    for (int i = 0; i < dimension; ++i) atom.position[i] = drawn.uniform();
  if (tagged(made.tags, random.one_in(4), "surface", "tangent")) {
    made.query.x = sum(atom.position, image(semiaxes, random.direction(dimension)));
    made.query.v = random.direction(dimension);
  } else {
    Vec w{1, random.octave(-6, 0) * random.sign(), 0};
    if (dimension == 3) w[2] = random.octave(-6, 0) * random.sign();
    const Vec n = drawn_across(random, w, dimension);
    made.query.x = sum(atom.position, image(semiaxes, plus(n, -random.between(1.05, 1.3) / length(w), w)));
    made.query.v = image(semiaxes, w);
  }
  if (random.one_in(3)) jitter(random, made.query.x, dimension, 2, source.precision);
}

}  // namespace

Family ellipsoid_edges() {
  return {"ellipsoid-edges",
          "Starts on the surface of slender tilted ellipsoids, and tangents along their length.",
          {{"surface", "the start is on the surface, but for rounding"},
           {"tangent", "the line touches the ellipsoid, but for rounding, and starts beside its end"}},
          make_edge};
}

}  // namespace lorentz::cases
