// A scene in integers, seen along its lattice planes. Private to oracle/.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <lorentz/horizon.hpp>
#include "oracle/exact/exact_problem.hpp"
#include "oracle/horizon/circle_gaps.hpp"

namespace lorentz::oracle {

/// { position + A y : |y| < 1 }, with `axes` the columns of A. A ball, even if it is given by semiaxes, has
/// A = axes[0][0] I.
template <std::size_t D>
struct Obstacle {
  ZVec<D> position;
  ZMatrix<D> axes;
  bool ball = true;

  /// As seen along the planes with this normal; its half-width is |A^T normal|.
  Blocked block(const ZVec<D>& normal) const;
};

template <std::size_t D>
struct ObstacleLattice {
  ZMatrix<D> vectors;  ///< short vectors, whatever the scene's vectors are, so numbers stay small
  ZMatrix<D> given;    ///< the scene's vectors, by which directions and planes are named
  ZMatrix<D> names;    ///< the components of `vectors` in `given`
  Z volume;            ///< |determinant|
  /// cofactors[i].vectors[k] is the determinant or 0. A normal with integer coefficients n in the cofactors
  /// is normal to the planes with the reciprocal indices n.
  ZMatrix<D> cofactors;
  std::vector<Obstacle<D>> obstacles;  ///< the largest first

  /// Distance between the lattice's planes with this normal, times the length of the normal.
  Z period(const ZVec<D>& normal) const;
  /// After a change of the vectors: sets the cofactors and the volume.
  void set_cofactors();
  /// After a change of the obstacles: puts the largest first.
  void sort_obstacles();
};

/// The scene with every length multiplied by 2^-exponent, so that `unit` is an integer, too (0: no unit).
template <std::size_t D>
struct ChannelScene {
  long exponent = 0;
  Z unit;
  std::vector<ObstacleLattice<D>> lattices;

  ChannelScene(const Scene& scene, double unit);
};

/// n_1 u_1 + ..
template <std::size_t D>
ZVec<D> combination(const ZVec<D>& n, const ZMatrix<D>& u) {
  return transposed(u) * n;
}

/// a / q * 2^exponent
template <std::size_t D>
Vec rounded(const ZVec<D>& a, const Z& q, long exponent);

template <std::size_t D>
using NormalVisitor = std::function<void(const LatticePoint<D>& normal)>;

/// The number of points n_1 b_1 + .. with |.|^2 < bound2, including the origin; the line of a shortest vector
/// counts as just three points. Counts by rows, not by points, and stops once there are more than `most`.
template <std::size_t D>
std::size_t points_in_ball(Basis<D> basis, const Z& bound2, std::size_t most);

/// Visits primitive n, one of each pair +-n, with |sum n_i b_i|^2 < bound2. If there are more than `most`
/// points to look at, visits none and returns false. `step`, if given, is told how many of all points have
/// been looked at.
template <std::size_t D>
bool visit_primitive(Basis<D> basis, const Z& bound2, std::size_t most, const NormalVisitor<D>& visit,
                     const std::function<void(std::size_t done, std::size_t total)>& step = {});

/// The normals, up to a factor, along which both lattices have rows so far apart that they may leave a way between
/// them, and perhaps further normals: at most two. Nothing if there may be many, because the lattices are
/// commensurable or the obstacles large.
std::optional<std::vector<ZVec<2>>> common_normals(const ObstacleLattice<2>& a, const ObstacleLattice<2>& b);

/// Sets horizon.cylinders, families and no_cylinders: channels along lines that lie in no planar channel.
void find_cylinders(const ChannelScene<3>& scene, Horizon& horizon, const SearchProgress& progress);

/// log2 |a|, roughly. It serves to choose between methods with the same result, and to refuse searches that
/// are too long.
double log2_of(const Z& a);

}  // namespace lorentz::oracle
