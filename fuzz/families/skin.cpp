// skin: starts outside an obstacle's surface, nearer to it than an ulp of the coordinates of either.
//
// With a Pythagorean triple (a, b, w) and semiaxes w A e_1, w B e_2, an obstacle around (a A, 0) has
// (0, -b B) exactly on its surface. The first component of a start there is zero, so it may be any tiny
// number: 2^-45 to 2^-100 of the radius outside. The atom's position is not zero, so x - p has many more
// digits than x and p. The time of entry is as small as that distance, so rounding leaves nothing of it.
// Whatever is compared with it (a limit, the time of another atom's obstacle whose surface is as near) is
// compared with noise.
//
// nearby: starts outside an obstacle, 2^-40 to 1/4 of its radius from where they enter it. With s = v . d the
// distance of the centre along the line and q half the chord, both times v, the time of entry is
// (s - q) / v^2. These two numbers are nearly equal; (d^2 - r^2) / (s + q) loses nothing. The difference
// loses a roundoff of the radius, half of what an ulp in the start may change. So only a tolerance of less
// than an ulp tells the two formulas apart.
#include <cmath>

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/scenes.hpp"

namespace lorentz::cases {
namespace {

struct Triple {
  int a, b, w;
};
constexpr Triple kTriples[] = {{1, 0, 1},   {3, 4, 5},   {4, 3, 5},   {5, 12, 13},
                               {12, 5, 13}, {8, 15, 17}, {24, 7, 25}, {20, 21, 29}};

// Semiaxes along the axes, up to 8 times as long as one another: exact products of small integers.
std::vector<Vec> drawn_semiaxes(Random& drawn, const Symmetry& symmetry, int w, double size, Vec& lengths) {
  std::vector<Vec> semiaxes;
  for (int i = 0; i < 3; ++i) {
    lengths[i] = size * drawn.whole(1, 8);
    Vec axis{};
    axis[i] = w * lengths[i];
    semiaxes.push_back(symmetry(axis));
  }
  return semiaxes;
}

// Adds another atom with nearly the same surface.
void add_twin(Random& drawn, NumberFormat precision, const Symmetry& symmetry, double size, Case& made) {
  Atom twin = made.scene.lattices[0].atoms[0];
  const double aside =
      size * (precision == NumberFormat::binary64 ? drawn.octave(-120, -45) : drawn.octave(-60, -18)) *
      drawn.sign();
  twin.position = sum(twin.position, symmetry(Vec{0, aside, 0}));
  if (drawn.one_in(2)) {
    made.scene.lattices.push_back(made.scene.lattices[0]);
    made.scene.lattices[1].atoms = {twin};
  } else {
    made.scene.lattices[0].atoms.push_back(twin);
  }
}

void make_skin(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const int dimension = drawn.one_in(2) ? 3 : 2;
  const Symmetry symmetry(drawn, dimension);
  made.scene = drawn.one_in(2) ? unit_scene(dimension, 1) : drawn_crystal(drawn, dimension).scene;
  Lattice& lattice = made.scene.lattices[0];
  const Triple triple = kTriples[drawn.below(std::size(kTriples))];
  const double size = std::ldexp(1, -drawn.exponent(dimension == 2 ? 12 : 10, 20));
  Vec lengths{size, size, size};
  Atom atom{{}, triple.w * size, {}};
  if (!tagged(made.tags, drawn.one_in(3), "ball", "ellipsoid")) {
    atom.semiaxes = drawn_semiaxes(drawn, symmetry, triple.w, size, lengths);
    atom.semiaxes.resize(static_cast<std::size_t>(dimension));
    atom.radius = 0;
  }
  atom.position = symmetry(Vec{triple.a * lengths[0], 0, 0});
  lattice.atoms = {atom};
  if (tagged(made.tags, drawn.one_in(3), "twin")) add_twin(drawn, source.precision, symmetry, size, made);
  const double gap = lengths[0] * (source.is_wide() ? random.octave(-100, -45) : random.octave(-60, -18));
  made.query.x = symmetry(Vec{-gap, -triple.b * lengths[1], 0});
  // Inwards: along the normal, beside it, or nearly along the surface.
  const double first = random.one_in(3) ? 0 : random.octave(-20, 1);
  const double second = triple.b == 0 || random.one_in(3) ? random.octave(-20, 1) : 1;
  const double third = dimension == 2 || random.one_in(3) ? 0 : random.between(-1, 1);
  made.query.v = symmetry(Vec{triple.b == 0 && first == 0 ? 1 : first, second, third});
}

void make_nearby(Source& source, Case& made) {
  Random &drawn = source.scene, &random = source.random;
  const int dimension = drawn.one_in(3) ? 3 : 2;
  made.scene = unit_scene(dimension, drawn.between(0.2, 0.5));
  if (drawn.one_in(2)) {
    made.tags.push_back("other-cell");
    made.scene.lattices[0].vectors[1][0] = drawn.between(0, 0.5);
  } else {
    made.tags.push_back("unit-cell");
  }
  const double r = made.scene.lattices[0].atoms[0].radius;
  const Vec n = random.direction(dimension), along = random.direction(dimension);
  made.query.x = scaled(n, r * (1 + random.octave(source.is_wide() ? -40 : -18, -2)));
  made.query.v = sum(scaled(n, -1), scaled(along, random.between(0, 0.8)));
}

}  // namespace

Family skin() {
  return {"skin",
          "Starts outside an obstacle by less than an ulp of its place, moving inwards.",
          {{"ball", "of a ball"},
           {"ellipsoid", "of an ellipsoid"},
           {"twin", "another atom's surface is as near"}},
          make_skin};
}

Family nearby() {
  return {"nearby",
          "Starts near the obstacle that they enter: the time is a difference that cancels.",
          {{"unit-cell", "the square or cubic lattice"}, {"other-cell", "a skewed one"}},
          make_nearby};
}

}  // namespace lorentz::cases
