// sizes: obstacles of every size that engines support, 1e-12 (2D) or 1e-7 (3D) to 1/2 of the cell, in scenes
// of every kind. A mistake in one octave of the radius, for one kind of scene, shows nowhere else; if sizes
// are drawn for another purpose, some of these never come up. So nothing is left to chance. Kinds and
// dimensions take turns, and so do the octaves of each, by steps that have no common factor with their
// number. The first few scenes are then as widely spread as possible, and no octave comes twice before each
// has come once.

#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"
#include "question/cases/drawn_flights.hpp"
#include "question/cases/scenes.hpp"

namespace lorentz::cases {
namespace {

enum Kind : std::size_t { kUnit, kCell, kMotif, kEllipsoid, kSuperposition, kMixed };
constexpr std::string_view kScenes[] = {"unit", "cell", "motif", "ellipsoid", "superposition", "mixed"};

// An obstacle whose radius or shortest semiaxis is `size`; an ellipsoid is up to 2^5 times as long as wide.
Atom sized_obstacle(Random& drawn, int dimension, double size, bool is_ball) {
  if (is_ball) return {{}, size, {}};
  Atom atom;
  const double most = std::min(0.4, 32 * size);
  const Vec a = drawn.direction(2);
  atom.semiaxes = {scaled(a, size), scaled({-a[1], a[0], 0}, drawn.between(size, most))};
  if (dimension == 3) atom.semiaxes.push_back({0, 0, drawn.between(size, most)});
  return atom;
}

Scene sized_scene(Random& drawn, std::size_t kind, int dimension, double size) {
  Scene scene = unit_scene(dimension, size);
  Lattice& lattice = scene.lattices[0];
  if (kind == kCell)
    for (int i = 1; i < dimension; ++i) lattice.vectors[i] = {drawn.uniform(), 1, i == 2 ? 1.0 : 0.0};
  if (kind == kMotif) {
    lattice.atoms.push_back(sized_obstacle(drawn, dimension, size * drawn.between(1, 2), true));
    for (int i = 0; i < dimension; ++i) lattice.atoms[1].position[i] = drawn.uniform();
  }
  if (kind == kEllipsoid) lattice.atoms[0] = sized_obstacle(drawn, dimension, size, false);
  if (kind == kSuperposition || kind == kMixed) {
    Lattice other = lattice;
    for (int i = 0; i < dimension; ++i) other.vectors[i] = scaled(lattice.vectors[i], drawn.between(1, 2));
    for (int i = 0; i < dimension; ++i) other.atoms[0].position[i] = drawn.uniform();
    if (kind == kMixed) other.atoms[0] = sized_obstacle(drawn, dimension, size, false);
    scene.lattices.push_back(other);
  }
  return scene;
}

// A flight off an obstacle of the last lattice, from its surface up to the precision of binary64, along its
// normal or nearly so.
void leave_obstacle(Random& random, Case& made) {
  const int lattice = static_cast<int>(made.scene.lattices.size()) - 1, dimension = made.scene.dimension;
  const auto& atoms = made.scene.lattices[lattice].atoms;
  const int which = static_cast<int>(random.below(atoms.size()));
  const Atom& atom = atoms[which];
  const Vec n = random.direction(dimension);
  const Vec arm = atom.is_ball() ? scaled(n, atom.radius) : image(atom.semiaxes, n);
  made.query.x = sum(atom.position, arm);
  made.query.v = sum(scaled(arm, 1 / length(arm)), random.vector(dimension, random.uniform()));
  made.query.from = ObstacleId{lattice, which, {}};
}

void make_sizes(Source& source, Case& made) {
  constexpr std::uint64_t kFlat = 38, kSolid = 22, kStepFlat = 23, kStepSolid = 13;
  Random &drawn = source.scene, &random = source.random;
  const std::uint64_t number = source.index / kCasesPerScene, kind = number % std::size(kScenes),
                      turn = number / std::size(kScenes);
  const int dimension = turn % 2 == 0 ? 2 : 3;
  const std::uint64_t octaves = dimension == 2 ? kFlat : kSolid,
                      step = dimension == 2 ? kStepFlat : kStepSolid;
  const int octave = -2 - static_cast<int>(turn / 2 * step % octaves);
  made.tags.emplace_back(kScenes[kind]);
  made.scene = sized_scene(drawn, kind, dimension, drawn.octave(octave, octave + 1));
  if (tagged(made.tags, random.one_in(3), "leaving")) return leave_obstacle(random, made);
  made.query.x = free_point(random, made.scene);
  made.query.v = random.one_in(4) ? near_integer_direction(random, dimension, source.precision)
                                  : random.direction(dimension);
}

}  // namespace

Family sizes() {
  return {"sizes",
          "Obstacles of every size that engines do, in scenes of every kind.",
          {{"unit", "the square or cubic lattice"},
           {"cell", "a skewed one"},
           {"motif", "two balls a cell"},
           {"ellipsoid", "an ellipse or ellipsoid, up to 2^5 times as long as wide"},
           {"superposition", "two lattices of balls"},
           {"mixed", "two lattices, the second of ellipsoids"},
           {"leaving", "`from` is the obstacle that the flight starts on"}},
          make_sizes};
}

}  // namespace lorentz::cases
