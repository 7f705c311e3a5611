// dense-rows: layers far apart, made of dense rows at right angles to the flight, which comes down to a layer
// at a small slope. Obstacles are about r / 80 apart within a row, rows are 1 apart, and layers are far
// enough apart for a free path of about a thousand rows. The layer's section of the cylinder begins at a tip;
// at the distance s from it, it is sqrt(2 r slope s) wide, which soon exceeds the spacing of the obstacles.
// So the first row after the tip is the one that is hit, and the search has to find it in a stretch of many
// rows. A search that takes the stretch in parts, short ones first, must leave no gap between them.
#include <cmath>

#include "cases/families/family_list.hpp"
#include "cases/scene_edit.hpp"
#include "cases/symmetry.hpp"

namespace lorentz::cases {
namespace {

void make_dense_rows(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const double r = drawn.octave(-5, -3), apart = r / drawn.between(66, 95);
  const double layers = 400 * r * r / apart * drawn.octave(0, 4);
  const Symmetry symmetry(drawn, 3);
  made.scene = lattice_scene(3,
                             {symmetry(Vec{apart, 0, 0}), symmetry(Vec{apart * drawn.uniform(), 1, 0}),
                              symmetry(Vec{drawn.uniform(), drawn.uniform(), layers})},
                             r);
  const bool skew = tagged(made.tags, random.one_in(4), "skew", "straight");
  const double slope = r * random.octave(-10, -6);
  made.query =
      symmetry(Query{Vec{apart * random.uniform(), random.uniform(), -r - slope * random.between(0, 2)},
                     Vec{skew ? random.octave(-12, -4) : 0, 1, slope},
                     {}});
}

}  // namespace

Family dense_rows() {
  return {"dense-rows",
          "Down to layers of dense rows at right angles to the flight: the first of many rows.",
          {{"straight", "at right angles"}, {"skew", "off that by 2^-12 to 2^-4"}},
          make_dense_rows};
}

}  // namespace lorentz::cases
