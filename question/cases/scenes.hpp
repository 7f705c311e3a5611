// The scenes that cases begin with, and changes of them; frames and symmetries.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "question/cases/random.hpp"

namespace lorentz::cases {

/// The lattices that families draw on: those of the catalogue (data/scenes/), repeated here so that a case
/// needs no file.
struct Crystal {
  std::string_view name;
  Scene scene;  ///< obstacles as in the catalogue: in most lattices about 4/5 of touching size
};

const std::vector<Crystal>& crystals();

/// A crystal of this dimension, drawn from them.
const Crystal& drawn_crystal(Random& random, int dimension);

inline Atom ball(const Vec& position, double radius) {
  return {position, radius, {}};
}

/// One lattice with one ball at the origin.
Scene lattice_scene(int dimension, const std::array<Vec, 3>& vectors, double radius);

/// Gives every ball this radius; ellipsoids stay.
void set_radius(Scene& scene, double radius);

/// Multiplies the size of every obstacle by the factor.
void scale_obstacles(Scene& scene, double factor);

/// Multiplies the lattice vectors and the positions of atoms by the factor.
void scale_places(Scene& scene, double factor);

/// A y, for the matrix A whose columns are the semiaxes.
Vec image(const std::vector<Vec>& semiaxes, const Vec& y);

/// A drawn unit vector at a right angle to v, which is not 0.
Vec drawn_across(Random& random, const Vec& v, int dimension);

/// The unit vector a, another at a right angle to it (in space drawn), and one at right angles to both.
std::array<Vec, 3> drawn_frame(Random& random, const Vec& a, int dimension);

/// Permutes and reflects the components of vectors and cells: a symmetry of the square or cubic lattice.
class Symmetry {
 public:
  Symmetry(Random& random, int dimension);
  Vec operator()(const Vec& a) const;
  Query operator()(const Query& query) const;

 private:
  std::array<int, 3> from_{0, 1, 2};
  std::array<int, 3> sign_{1, 1, 1};
};

}  // namespace lorentz::cases
