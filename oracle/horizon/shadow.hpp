// The shadow that a periodic scene of balls casts along one of its lattice vectors g consists of discs around
// the points of a plane lattice. The question is whether the open discs cover the plane except for points and
// lines, or leave a hole. Private to oracle/.
//
// A point x is seen as X = x cross g, in the plane perpendicular to g: its projection, turned by a right
// angle and |g| times as long. So everything stays an integer, and the disc of a ball of radius r is
// |X - C|^2 < r^2 g^2.
#pragma once

#include <optional>
#include <vector>

#include "oracle/exact/quadratic.hpp"
#include "oracle/horizon/channel_scene.hpp"

namespace lorentz::oracle {

struct Disc {
  ZVec<3> centre;  ///< within the plane, relative to some point
  Z radius;        ///< of the ball
};

struct Shadow {
  ZVec<3> along;                         ///< g
  Z along2;                              ///< g.g
  std::array<LatticePoint<3>, 2> basis;  ///< of the plane lattice, reduced
  std::vector<Disc> discs;               ///< one for each ball of the motif in view, the largest first

  /// The shadow of the largest ball of `lattice` along a lattice vector; e1 and e2 complete this vector to a
  /// basis of the lattice.
  Shadow(const ObstacleLattice<3>& lattice, const ZVec<3>& along, const ZVec<3>& e1, const ZVec<3>& e2);

  /// Adds balls until there are `count` of them.
  void see(const ObstacleLattice<3>& lattice, std::size_t count);

  /// The discs, with all their translates, whose centres are at most `reach` (plus their radius, if
  /// `add_radius`) times |g| from `point`. Their centres are relative to `point`. (A disc whose centre is
  /// `point` is among them.)
  std::vector<Disc> discs_around(const ZVec<3>& point, const Z& reach, bool add_radius) const;
};

/// A point of the plane: (X - centre of disc `disc`) * 2^bits, rounded. Only signs are decided exactly, and
/// they are decided before such a point is made.
inline constexpr unsigned long kFineBits = 64;
struct HolePoint {
  std::size_t disc;
  ZVec<3> offset;
  unsigned long bits = kFineBits;
};

/// Tests whether the largest disc alone would leave a hole. If so, returns the point furthest from all of its
/// centres.
std::optional<HolePoint> hole_of_largest(const Shadow& shadow, unsigned long bits = kFineBits);

/// A point on the boundary of a hole, if there is one. Adds to `work` the number of points and discs
/// compared.
std::optional<HolePoint> hole_of_all(const Shadow& shadow, std::size_t& work, unsigned long bits = kFineBits);

struct HoleCentre {
  Vec offset{};  ///< from the centre of the ball `disc` of the HolePoint, perpendicular to g, rounded; in
                 ///< units of the largest ball's radius
  Quadratic clearance;  ///< distance of the line that `offset` is rounded from to the nearest ball
};

/// Climbs from a point of the hole, or of its boundary, away from the discs: a line with room around it, found in
/// binary64; its distance from the discs is exact. It is above 0 unless the hole is too small for the bits of the point.
HoleCentre centre_of(const Shadow& shadow, const HolePoint& hole);

}  // namespace lorentz::oracle
