// The obstacles: lattices of balls and ellipsoids. Every number is a binary64 value and means exactly that
// dyadic rational. Lengths are in the scene's own unit.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/vec.hpp>

namespace lorentz {

/// An obstacle of the motif: an open ball of `radius` > 0, or the open ellipsoid { position + A y : |y| < 1 }
/// whose matrix A has the columns `semiaxes`. Cell coordinates n count from `position`.
struct Atom {
  Vec position{};
  double radius = 0;
  std::vector<Vec> semiaxes;  ///< empty for a ball, else `dimension` linearly independent vectors

  bool is_ball() const { return semiaxes.empty(); }

  /// True if the numbers are the same (-0 equals 0), in the same order.
  friend bool operator==(const Atom&, const Atom&) = default;
};

/// Linearly independent primitive vectors u_1..u_k, and the motif that is repeated at n_1 u_1 + ... + n_k
/// u_k. In d dimensions, k = d is a crystal, d - 1 a layer or (in the plane) a row, and 0 single obstacles.
struct Lattice {
  std::array<Vec, 3> vectors{};  ///< those after the first k are zero
  std::vector<Atom> atoms;
  int rank = 3;  ///< k: in how many directions the lattice repeats; 3 is a crystal in the plane, too

  int rank_in(int dimension) const { return rank < dimension ? rank : dimension; }  ///< k

  friend bool operator==(const Lattice&, const Lattice&) = default;
};

/// One or several lattices of obstacles in 2 or 3 dimensions; obstacles may overlap.
struct Scene {
  int dimension = 0;
  std::vector<Lattice> lattices;

  friend bool operator==(const Scene&, const Scene&) = default;
};

/// True if each lattice repeats in as many directions as the scene has dimensions.
bool is_crystal(const Scene& scene);

/// The numbers of components of vectors and cells: of a scene, or of a dimension if all lattices are
/// crystals. The dimension 0 stands for a scene that is not known yet: vectors without components. Throws
/// InputError for other dimensions than 0, 2 and 3.
class Components {
 public:
  Components(int dimension) : dimension_(checked_dimension(dimension)) {}
  Components(const Scene& scene) : Components(scene.dimension) {
    if (is_crystal(scene)) return;
    for (const Lattice& lattice : scene.lattices) ranks_.push_back(lattice.rank_in(dimension_));
  }

  int of_vectors() const { return dimension_; }
  int of_cells(int lattice) const {  ///< the dimension if the lattice does not exist
    const auto l = static_cast<std::size_t>(lattice);
    return l < ranks_.size() ? ranks_[l] : dimension_;
  }

 private:
  static int checked_dimension(int dimension);

  int dimension_;
  std::vector<int> ranks_;  ///< one for each lattice; empty if all are crystals
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

/// What is wrong with a scene, or nothing if it is valid. Checks the dimension, that numbers are finite,
/// radii above zero and semiaxes complete, and that nothing is out of the plane. The oracle decides exactly
/// whether the primitive vectors are independent (include/lorentz/scene_check.hpp).
std::optional<std::string> flaw_of(const Scene& scene);

/// Returns the scene if it is valid; otherwise throws InputError, which names the place and the remedy.
/// Everything that takes a scene calls this first, once.
const Scene& checked(const Scene& scene);

/// The unit square (d = 2) or cubic (d = 3) lattice with one ball of this radius at the origin. Throws
/// InputError for another dimension.
Scene unit_scene(int dimension, double radius);

/// True if the scene is one unit square or cubic lattice with one ball centred at the origin, and its
/// primitive vectors are in the order of the axes.
bool is_unit_scene(const Scene& scene);

}  // namespace lorentz
