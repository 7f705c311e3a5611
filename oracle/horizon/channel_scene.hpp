// A scene as integers, seen along its lattice planes. Private to oracle/.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <vector>

#include "oracle/exact/exact_problem.hpp"
#include "oracle/horizon/circle_gaps.hpp"

namespace lorentz::oracle {

/// { position + A y : |y| < 1 }, `axes` the columns of A; a ball, also one given by semiaxes, has A =
/// axes[0][0] I.
template <std::size_t D>
struct Obstacle {
  ZVec<D> position;
  std::array<ZVec<D>, D> axes;
  bool ball = true;

  /// Squared half-width seen along the planes of this normal: |A^T normal|^2.
  Z half_width2(const ZVec<D>& normal) const;
};

template <std::size_t D>
struct ObstacleLattice {
  std::array<ZVec<D>, D> vectors;  ///< short ones, whatever the scene's are: numbers stay small
  std::array<ZVec<D>, D> given;    ///< the scene's, by which directions and planes are named
  std::array<ZVec<D>, D> names;    ///< of `vectors`: their components in `given`
  Z volume;                        ///< |determinant|
  /// cofactors[i].vectors[k] = determinant or 0: a normal with integer coefficients n in these stands on the
  /// planes with the reciprocal indices n. Coefficients come with each (LatticePoint::n).
  Basis<D> cofactors;
  std::vector<Obstacle<D>> obstacles;  ///< the largest first

  /// Distance of the lattice's planes with this normal, times the normal's length.
  Z period(const ZVec<D>& normal) const;
  Blocked block(const Obstacle<D>& obstacle, const ZVec<D>& normal) const;
};

/// The scene with every length multiplied by 2^-exponent, so that `unit` too (0: none) is an integer.
template <std::size_t D>
struct ChannelScene {
  long exponent = 0;
  Z unit;
  std::vector<ObstacleLattice<D>> lattices;

  ChannelScene(const Scene& scene, double unit);
};

/// The gaps that one lattice leaves between its planes with this normal, in one period. Adds to `work` the
/// number of blocks it looked at: seldom all.
template <std::size_t D>
std::vector<Gap> gaps_of(const ObstacleLattice<D>& lattice, const ZVec<D>& normal, const Z& period,
                         std::size_t& work);

/// The cofactors with a volume: for vectors that were transformed.
template <std::size_t D>
void set_cofactors(ObstacleLattice<D>& lattice);

template <std::size_t D>
using NormalVisitor = std::function<void(const LatticePoint<D>& normal)>;

/// How many points n_1 b_1 + .. have |.|^2 < bound2, the origin among them; of those on the line of a
/// shortest vector just three. Counts rows, not points, and no further than to more than `most`.
template <std::size_t D>
std::size_t points_in_ball(Basis<D> basis, const Z& bound2, std::size_t most);

/// Visits primitive n, one of each pair +-n, with |sum n_i b_i|^2 < bound2; false, and none was visited, if
/// there are more than `most` points to look at. `step`, if any, hears how many points of all were looked at.
template <std::size_t D>
bool visit_primitive(Basis<D> basis, const Z& bound2, std::size_t most, const NormalVisitor<D>& visit,
                     const std::function<void(std::size_t done, std::size_t total)>& step = {});

/// log2 |a|, roughly; for choices between ways that lead to the same end, and for refusals.
double log2_of(const Z& a);

}  // namespace lorentz::oracle
