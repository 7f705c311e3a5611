// A scene as integers, seen along its lattice planes. Private to oracle/.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <vector>

#include "oracle/exact/exact_problem.hpp"
#include "oracle/horizon/circle_gaps.hpp"

namespace lorentz::oracle {

/// { position + A y : |y| < 1 }, `axes` the columns of A; a ball has A = axes[0][0] I.
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
  std::array<ZVec<D>, D> vectors;
  Z volume;  ///< |determinant|
  /// cofactors[i].vectors[k] = determinant or 0: a normal with integer coefficients n in these stands on the
  /// planes with the reciprocal indices n. Coefficients come with each (LatticePoint::n).
  Basis<D> cofactors;
  std::vector<Obstacle<D>> obstacles;  ///< the largest first

  /// Distance of the lattice's planes with this normal, times the normal's length.
  Z period(const ZVec<D>& normal) const;
  Block block(const Obstacle<D>& obstacle, const ZVec<D>& normal) const;
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

/// Visits primitive n, one of each pair +-n, with |sum n_i b_i|^2 < bound2; false if there are more than
/// `most` points to look at (then some were visited).
template <std::size_t D>
bool visit_primitive(Basis<D> basis, const Z& bound2, std::size_t most, const NormalVisitor<D>& visit);

/// log2 |a|, roughly; for choices between ways that lead to the same end, and for refusals.
double log2_of(const Z& a);

}  // namespace lorentz::oracle
