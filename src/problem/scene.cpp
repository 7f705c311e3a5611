#include <lorentz/scene.hpp>

#include <algorithm>

#include <lorentz/errors.hpp>
#include "src/problem/scene_geometry.hpp"

namespace lorentz {
namespace {

void check_dimension(int dimension) {
  if (dimension != 2 && dimension != 3)
    throw InputError("dimension: needs 2 or 3, not " + std::to_string(dimension));
}

std::optional<std::string> flaw_of_atom(const Atom& atom, int dimension) {
  if (!all_finite(atom.position)) return "position is not finite";
  if (atom.is_ball()) {
    if (!std::isfinite(atom.radius)) return "radius is not finite";
    if (!(atom.radius > 0)) return "radius must be above zero";
    return std::nullopt;
  }
  if (atom.semiaxes.size() != static_cast<std::size_t>(dimension))
    return "needs as many semiaxes as dimensions (" + std::to_string(dimension) + ")";
  for (const Vec& axis : atom.semiaxes)
    if (!all_finite(axis)) return "a semiaxis is not finite";
  return std::nullopt;
}

bool leaves_plane(const Scene& scene) {
  const auto leaves = [](const Vec& a) { return a[2] != 0; };
  return std::ranges::any_of(scene.lattices, [&](const Lattice& lattice) {
    return std::ranges::any_of(lattice.vectors, leaves) ||
           std::ranges::any_of(lattice.atoms, [&](const Atom& atom) {
             return leaves(atom.position) || std::ranges::any_of(atom.semiaxes, leaves);
           });
  });
}

}  // namespace

std::optional<std::string> flaw_of(const Scene& scene) {
  if (scene.dimension != 2 && scene.dimension != 3) return "dimension must be 2 or 3";
  if (scene.dimension == 2 && leaves_plane(scene))
    return "vectors have two components in the plane: the third must be zero";
  if (scene.lattices.empty()) return "a scene needs at least one lattice";
  for (std::size_t l = 0; l < scene.lattices.size(); ++l) {
    const Lattice& lattice = scene.lattices[l];
    const std::string where = "lattice " + std::to_string(l);
    if (lattice.rank < 0 || lattice.rank > 3)
      return where + ": needs from 0 to " + std::to_string(scene.dimension) + " primitive vectors";
    for (int i = 0; i < 3; ++i) {
      if (!all_finite(lattice.vectors[i])) return where + ": a primitive vector is not finite";
      if (i >= lattice.rank_in(scene.dimension) && lattice.vectors[i] != Vec{})
        return where + ": has more primitive vectors than it says";
    }
    if (lattice.atoms.empty()) return where + ": needs at least one atom";
    for (std::size_t a = 0; a < lattice.atoms.size(); ++a)
      if (auto flaw = flaw_of_atom(lattice.atoms[a], scene.dimension))
        return where + ", atom " + std::to_string(a) + ": " + *flaw;
  }
  return std::nullopt;
}

const Scene& checked(const Scene& scene) {
  if (const auto flaw = flaw_of(scene)) throw InputError("scene: " + *flaw);
  return scene;
}

bool is_crystal(const Scene& scene) {
  return std::ranges::all_of(scene.lattices,
                             [&](const Lattice& lattice) { return lattice.rank >= scene.dimension; });
}

int Components::checked_dimension(int dimension) {
  if (dimension != 0) check_dimension(dimension);
  return dimension;
}

Scene unit_scene(int dimension, double radius) {
  check_dimension(dimension);
  Scene scene;
  scene.dimension = dimension;
  Lattice lattice;
  for (int i = 0; i < dimension; ++i) lattice.vectors[i][i] = 1;
  lattice.atoms.push_back(Atom{{}, radius, {}});
  scene.lattices.push_back(lattice);
  return scene;
}

bool is_unit_scene(const Scene& scene) {
  if (scene.lattices.size() != 1 || scene.lattices[0].atoms.size() != 1) return false;
  const Atom& atom = scene.lattices[0].atoms[0];
  return atom.is_ball() && atom.position == Vec{} && is_crystal(scene) &&
         scene.lattices[0].vectors == unit_scene(scene.dimension, 1).lattices[0].vectors;
}

}  // namespace lorentz
