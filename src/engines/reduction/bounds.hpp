// Every rounding-error constant of the reduction engine. docs/bounds.md has the lemmas and derivations,
// tests/engines/bounds_test.cpp computes each constant again, by running the formulas of predicates.hpp on
// numbers that carry their error.
#pragma once

namespace lorentz {

/// Unit roundoff of binary64: one operation errs by at most u times its result.
inline constexpr double kRoundoff = 0x1p-53;

/// Velocity and offset components below kTinyComponent (engine.hpp; the largest component of v is in [1, 2),
/// lattice vectors are about 1) are taken as zero, so that no product underflows; what that changes, over
/// 2^53 cells, is below kFlushed.
inline constexpr double kFlushed = 0x1p-390;

/// |computed height - height| <= kHeight u (|y| + |n D_R| + |m D_L|): predicates.hpp, height_in_row.
inline constexpr double kHeight = 8;

/// A coordinate dual_i . a of a vector a, times |B_i| / (|a|_1 kappa^2), kappa = |B_1| |B_2| |B_3| / volume.
inline constexpr double kCoordinate = 32;

/// A start's coordinates from its home cell are within 1/2 and this; scenes for which they are not known so
/// well are not done.
inline constexpr double kMaxHomeError = 0x1p-12;

/// |d|^2 - r^2, relative to |d|^2 + r^2.
inline constexpr double kInside = 6;

/// d . G d - r^2 for an ellipsoid, relative to |G| |d|^2 + r^2.
inline constexpr double kInsideEllipsoid = 16;

/// The height of an anchor, from the compensated sum of its terms: relative to it, and to the terms.
inline constexpr double kAnchor = 3, kAnchorTerms = 0x1p-100;

/// A sum s + n S_R + m S_L of positions along the line, likewise.
inline constexpr double kAlong = 8;

/// r |v| as computed from the sum of squares.
inline constexpr double kRho = 6;

/// 3D, across in units of r: a point's coordinates as sums along the basis, relative to the sizes of the
/// terms; and the scale of the coordinates (of ellipsoids: times the condition of the shape).
inline constexpr double kAcross = 8, kScale = 32;

/// 3D, where a lattice line enters the cylinder: relative to the sizes of the terms.
inline constexpr double kLine = 32;

/// v x d, v . d and d . d in double-double, relative to |v| |d|, |v| |d|, |d|^2.
inline constexpr double kStable = 0x1p-100;

}  // namespace lorentz
