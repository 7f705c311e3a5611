// slender: ellipses and ellipsoids up to 2^12 times as long as wide, tilted in the unit cell, and flown along
// their long axis. In their own metric such a flight is the slow one: v^2, heights and the width of the strip
// are differences of terms 2^24 times as large, and a bound that is right for discs is too small by the
// condition number. The line passes the obstacle's end, or its flank, from which it leans away by 2^-40 to
// 2^-4.

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/drawn_flights.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/scenes.hpp"
#include "question/cases/ulps.hpp"

namespace lorentz::cases {
namespace {

// The long axis: at random angles, or of small integers.
Vec drawn_axis(Random& drawn, int dimension) {
  const Vec any = drawn.direction(dimension);
  if (!drawn.one_in(3)) return any;
  const Vec a = to_vec(drawn_primitive(drawn, dimension, 4));
  return scaled(a, 1 / length(a));
}

// Needles, and in space blades, too.
Atom drawn_needle(Random& drawn, int dimension, Case& made) {
  const std::array<Vec, 3> frame = drawn_frame(drawn, drawn_axis(drawn, dimension), dimension);
  const bool cell = drawn.one_in(2);
  const double size = cell ? drawn.between(0.2, 0.49) : drawn.octave(-1, 2),
               thin = size * drawn.octave(-12, -2);
  tagged(made.tags, cell, "in-its-cell", "through-cells");
  const bool blade = tagged(made.tags, dimension == 3 && drawn.one_in(2), "blade", "needle");
  Atom atom;
  atom.semiaxes = {scaled(frame[0], size), scaled(frame[1], thin)};
  if (dimension == 3) atom.semiaxes.push_back(scaled(frame[2], blade ? size * drawn.between(0.5, 1) : thin));
  return atom;
}

// A start up to a few cells before the obstacle's centre, and beside it by about its width: at its edge to
// within 2^-50 to 1.
Vec beside(Random& random, NumberFormat precision, const Atom& atom) {
  const Vec &along = atom.semiaxes[0], &across = atom.semiaxes[1 + random.below(atom.semiaxes.size() - 1)];
  const double edge =
      random.one_in(3)
          ? random.between(-1.5, 1.5)
          : random.sign() * (1 + random.octave(-50 + missing_bits(precision), -1) * random.sign());
  const Vec before = scaled(along, -random.between(0.5, random.one_in(2) ? 2 : 40));
  return sum(atom.position, plus(before, edge, across));
}

void make_slender(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const int dimension = drawn.one_in(2) ? 3 : 2;
  made.scene = unit_scene(dimension, 0.25);
  made.scene.lattices[0].atoms[0] = drawn_needle(drawn, dimension, made);
  const Atom& atom = made.scene.lattices[0].atoms[0];
  const Vec& along = atom.semiaxes[0];
  made.query.v = random.one_in(2) ? along : scaled(along, random.between(0.5, 2) / length(along));
  if (tagged(made.tags, random.one_in(2), "leaning", "lengthwise"))
    made.query.v =
        sum(made.query.v,
            random.vector(dimension, length(made.query.v) *
                                         random.octave(-40 + missing_bits(source.precision) / 2, -4)));
  made.query.x = tagged(made.tags, random.one_in(3), "anywhere", "at-its-edge")
                     ? free_point(random, made.scene)
                     : beside(random, source.precision, atom);
}

}  // namespace

Family slender() {
  return {"slender",
          "Slender tilted ellipses and ellipsoids in unit cells, flown along their long axis.",
          {{"needle", "2^1 to 2^12 times as long as wide"},
           {"blade", "two long semiaxes and a short one"},
           {"in-its-cell", "shorter than the cell"},
           {"through-cells", "up to eight cells long, between its translates or through them"},
           {"lengthwise", "along the long axis but for rounding"},
           {"leaning", "2^-40 to 2^-4 off it"},
           {"anywhere", "from anywhere in the cell"},
           {"at-its-edge", "towards an obstacle whose edge the line passes within 2^-50 to 1 of its width"}},
          make_slender};
}

}  // namespace lorentz::cases
