// One atom of one lattice, prepared for the reduction engine: balls of one radius, or ellipsoids of one
// shape, on a Bravais lattice, with a short basis of it. All of this is computed once per scene.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <lorentz/scene.hpp>
#include "src/engines/base/double_double.hpp"
#include "src/engines/reduction/shape.hpp"

namespace lorentz {

using WideVec = std::array<Wide, 3>;

struct Bravais {
  int dimension = 0;
  int lattice = 0, atom = 0;  ///< their numbers in the scene
  std::int8_t rank = 0;       ///< the number of vectors of the lattice
  bool unit = false;  ///< square or cubic, spacing 1, an obstacle at the origin: all but the shape is exact
  double radius = 0;  ///< for an ellipsoid: the shape's
  Vec position{};
  std::int64_t stride[3]{1, 1, 1};  ///< powers of two: obstacles that overlap their own translates are those
                                    ///< of several lattices, coarser by this along B_i, in which none does
  Vec shift{};       ///< which of them: its cells have coordinates n_i + shift_i, where 0 <= shift_i < 1
  WideVec basis[3];  ///< a short basis B_i = stride[i] sum_j transform[i][j] u_j; for i >= rank, vectors
                     ///< perpendicular to it (of length 1); for i >= dimension, the axes
  std::int64_t transform[3][3]{};
  Vec dual[3];                  ///< dual_i . B_j = delta_ij, in plain binary64; 0 for rank <= i < dimension
  double coordinate_error = 0;  ///< a coordinate dual_i . a errs by at most this times |a_1| + |a_2| + |a_3|
  Vec reach{};                  ///< an obstacle that contains x has coordinates within reach_i of those of x
  bool reaches_out = true;      ///< some reach is so large that x may lie in an obstacle of another cell
  double volume = 0;            ///< of a cell (2D: area)
  double basis_error = 0;       ///< of each component of a basis vector, at most
  Vec primitive[3];             ///< u_i; for i >= rank, as B_i
  bool whole = false;           ///< none of these, of position and of the shape became zero in this scale
  bool is_ball = true;
  bool exact = false;            ///< the basis vectors are binary64, and those of the scene, without error
  std::int64_t inverse[3][3]{};  ///< of transform: u_i = sum_j inverse[i][j] B_j / stride[j]
  Shape shape;                   ///< only in scenes that have ellipsoids; there for balls, too
};

/// v x l, and a bound on its error, of the vector l = n_0 B_0 + n_1 B_1 of a lattice in the plane, in sums without
/// rounding. Nothing changes where that fails.
void set_height_unrounded(const Bravais& lattice, const double (&v)[2], const double (&n)[2], Wide& height,
                          double& error);

/// All lengths are scaled by 2^-exponent so that the shortest vector of the first lattice lies in [1, 2). If
/// the first lattice is a single obstacle, its radius does. The unit lattices keep their own lengths.
struct PreparedScene {
  int exponent = 0;
  double unit = 1, inverse_unit = 1;  ///< 2^exponent, 2^-exponent
  std::vector<Bravais>
      atoms;                ///< in the order of (lattice, atom); those of one that overlaps itself together
  bool ellipsoids = false;  ///< the scene has ellipsoids
  bool strides = false;     ///< atoms of it overlap their own translates
  int least_rank = 3, most_rank = 0;  ///< of the lattices
  std::string beyond;                 ///< why the engine does not support the scene; empty if it does
};

/// Throws InputError if the scene is invalid.
PreparedScene prepare(const Scene& scene);

}  // namespace lorentz
