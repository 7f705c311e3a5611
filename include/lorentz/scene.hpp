// The obstacles: lattices of balls and ellipsoids. Every number is a binary64 value and means exactly the
// dyadic rational that it is; lengths are in the scene's own unit.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/vec.hpp>

namespace lorentz {

/// An obstacle of the motif: an open ball of `radius` > 0, or the open ellipsoid { position + A y : |y| < 1 }
/// whose matrix A has the columns `semiaxes`. A cell coordinate n counts from `position`.
struct Atom {
  Vec position{};
  double radius = 0;
  std::vector<Vec> semiaxes;  ///< empty for a ball, else `dimension` linearly independent vectors

  bool is_ball() const { return semiaxes.empty(); }

  /// The same numbers (-0 is 0), in the same order.
  friend bool operator==(const Atom&, const Atom&) = default;
};

/// Primitive vectors u_1..u_k (linearly independent) and the motif that is repeated at n_1 u_1 + ... + n_k
/// u_k. In d dimensions k = d is a crystal, d - 1 a layer or (in the plane) a row, 0 single obstacles.
struct Lattice {
  std::array<Vec, 3> vectors{};  ///< those that it does not have are zero
  std::vector<Atom> atoms;
  int missing = 0;  ///< d - k: directions in which it does not repeat

  int rank(int dimension) const { return dimension - missing; }  ///< k

  friend bool operator==(const Lattice&, const Lattice&) = default;
};

/// One or several lattices of obstacles in 2 or 3 dimensions; obstacles may overlap.
struct Scene {
  int dimension = 0;
  std::vector<Lattice> lattices;

  friend bool operator==(const Scene&, const Scene&) = default;
};

/// Does each lattice repeat in as many directions as there are?
bool is_crystal(const Scene& scene);

/// How many components vectors and cells have: in a scene, or in a dimension if all lattices are crystals.
class Components {
 public:
  Components(int dimension) : dimension_(dimension) {}
  Components(const Scene& scene) : dimension_(scene.dimension) {
    if (is_crystal(scene)) return;
    for (const Lattice& lattice : scene.lattices) ranks_.push_back(lattice.rank(dimension_));
  }

  int of_vectors() const { return dimension_; }
  int of_cells(int lattice) const {  ///< of a lattice that is not there: the dimension
    const auto l = static_cast<std::size_t>(lattice);
    return l < ranks_.size() ? ranks_[l] : dimension_;
  }

 private:
  int dimension_;
  std::vector<int> ranks_;  ///< of each lattice; empty: all crystals
};

/// Calls visit(atom) for each atom of the scene, lattice by lattice.
template <class Visit>
void for_each_atom(Scene& scene, const Visit& visit) {
  for (Lattice& lattice : scene.lattices)
    for (Atom& atom : lattice.atoms) visit(atom);
}

template <class Visit>
void for_each_atom(const Scene& scene, const Visit& visit) {
  for (const Lattice& lattice : scene.lattices)
    for (const Atom& atom : lattice.atoms) visit(atom);
}

/// What is wrong with a scene, or nothing: dimension, finite numbers, radii above zero, semiaxes complete, nothing out
/// of the plane. That the primitive vectors are independent is decided exactly by the oracle
/// (include/lorentz/scene_check.hpp).
std::optional<std::string> flaw_of(const Scene& scene);

/// The scene, if it has no flaw; else throws InputError, which names the place and the remedy. What takes a scene calls
/// this first, once.
const Scene& checked(const Scene& scene);

/// The unit square (d = 2) or cubic (d = 3) lattice with one ball of this radius at the origin.
Scene unit_scene(int dimension, double radius);

/// True if the scene is one unit square or cubic lattice with one ball centred at the origin, the primitive
/// vectors in the order of the axes.
bool is_unit_scene(const Scene& scene);

}  // namespace lorentz
