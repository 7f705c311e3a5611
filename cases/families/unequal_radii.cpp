// unequal-radii: balls of one lattice in space whose radii differ by 2^3 to 2^6. The free paths differ by the
// square of that, and a basis that is short for a window of one length is long for a window of the other. An
// engine that prepares a direction for one atom and continues from there for the next has to change the scale
// along the flight, too.
#include <cmath>

#include "cases/crystals.hpp"
#include "cases/families/family_list.hpp"
#include "cases/free_start.hpp"

namespace lorentz::cases {
namespace {

void make_unequal(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  made.scene = drawn.one_in(2) ? unit_scene(3, 1) : drawn_crystal(drawn, 3).scene;
  Lattice& lattice = made.scene.lattices[0];
  const double small = drawn.octave(-12, -9), large = small * drawn.octave(3, 6);
  const bool small_first = tagged(made.tags, drawn.one_in(2), "small-first", "large-first");
  lattice.atoms = {{{}, small_first ? small : large, {}}, {{}, small_first ? large : small, {}}};
  for (double& component : lattice.atoms[1].position) component = drawn.between(0.2, 0.8);
  made.query = free_flight(random, made.scene);
}

}  // namespace

Family unequal_radii() {
  return {"unequal-radii",
          "Two balls a cell in space, one 2^3 to 2^6 times as large as the other.",
          {{"small-first", "the first atom is the smaller one"}, {"large-first", "the larger one"}},
          make_unequal};
}

}  // namespace lorentz::cases
