// Every constant of a decision of the reduction engine, but two that all engines share (kTinyComponent in
// engine_base.hpp, kMaxStart in engine.hpp). First what formulas err by: docs/bounds.md derives
// each of these, and tests/engines/bounds_test.cpp computes it again, by running the engine's own formulas
// (formulas.hpp) on numbers that carry their error. Then by how much ranges are widened, which follows from
// them. The last ones are not error bounds: caps, ranges, and from where on another formula is used.
#pragma once

namespace lorentz {

/// u of binary64: one operation errs by at most u times its result. And u^2, the unit of double-double.
inline constexpr double kRoundoff = 0x1p-53, kWideRoundoff = 0x1p-106;

// ---- Errors of formulas, in units of the roundoff if not said otherwise -----------------------------------

/// Velocity and offset components below kTinyComponent (the largest component of v is in [1, 2), lattice
/// vectors are about 1) are taken as zero, so that no product underflows; what that changes, over 2^53 cells,
/// is below kFlushed.
inline constexpr double kFlushed = 0x1p-390;

/// What that changes in a slack r^2 |v|^2 - |v x d|^2, over kMaxCell cells, is below this.
inline constexpr double kFlushedSlack = 0x1p-380;

/// |computed height - height| <= kHeight u (|y| + |n D_R| + |m D_L|): formulas.hpp, height_in_row.
inline constexpr double kHeight = 8;

/// A coordinate dual_i . a of a vector a, times |B_i| / (|a|_1 kappa^2), kappa = |B_1| |B_2| |B_3| / volume.
inline constexpr double kCoordinate = 32;

/// |d|^2 - r^2, relative to |d|^2 + r^2.
inline constexpr double kInside = 6;

/// d . G d - r^2 for an ellipsoid, relative to |G| |d|^2 + r^2.
inline constexpr double kInsideEllipsoid = 16;

/// The height of an anchor, a compensated sum: relative to it, and (absolutely) to its terms.
inline constexpr double kAnchor = 3, kAnchorTerms = 0x1p-100;

/// Positions along the line s + n S_R + m S_L, relative to the terms; on the unit square S is one sum of products.
inline constexpr double kAlong = 9, kAlongOnUnit = 8;

/// r |v| as computed from the sum of squares, and the roundings of a comparison with it.
inline constexpr double kRho = 6;

/// 2D, the number of the row beside the start: relative to its terms.
inline constexpr double kRowNumber = 18;

/// 2D, where a row enters the strip, from (y + n D_R - rho) / D_L: relative to the terms.
inline constexpr double kRowEntry = 16;

/// 2D, rows that a unit of s passes: relative (absolutely).
inline constexpr double kRowSlope = 0x1p-48;

/// 3D, across in units of r: a point's coordinates as sums along the basis, relative to the sizes of the
/// terms; and the scale of the coordinates (of ellipsoids: times the condition of the shape).
inline constexpr double kAcross = 8, kScale = 32;

/// What a sum without rounding loses when it is rounded, in units of u; a slack in the metric of a shape, which
/// is such a sum and the fourth power of a quotient of two of them. And v x d whose large terms are summed
/// without rounding: in units of u^2 of itself and of what |v| takes with the home cell, and this beside it.
inline constexpr double kUnroundedPlace = 4, kUnroundedSlack = 64, kCross = 12, kFromOrigin = 6;

/// 3D, where a lattice line enters the cylinder: its moment about the flight, relative to the sizes of the
/// terms; in units of that, how far its discriminant is raised, and the ends of its interval are moved out.
inline constexpr double kLine = 32, kDiscriminant = 8, kLineEnd = 4;

/// 3D, the tilt of a family of lattice planes, relative to the two vectors that it is computed from; and the
/// distance xi at which the line passes a plane, relative to its terms.
inline constexpr double kTilt = 32, kPlane = 512;

/// 3D, z in a window (which is of length 1) from the anchor (absolutely); and where the next window begins.
inline constexpr double kWindowStart = 0x1p-48, kNextWindow = 2;

/// v x d, v . d and d . d in double-double, relative to |v| |d|, |v| |d|, |d|^2 (absolutely).
inline constexpr double kStable = 0x1p-102;

/// In double-double, of such numbers: a form in a shape's metric, and a quotient; |d|^2 - r^2, relative to
/// r^2 (absolutely). In units of u: the root of a slack's high part alone.
inline constexpr double kStableForm = 3 * kStable, kStableTime = 2 * kStable, kStableGap = 8 * kStable;
inline constexpr double kRoot = 2;

/// Many flights at once, a time that is soon rounded: what s, v^2 and the quotient err by, and what
/// double-double would, relative to |v| |d| (absolutely); 2D, the slack, relative to rho^2.
inline constexpr double kSoonTime = 0x1p-94, kSoonSlack = 16;

/// The place of an obstacle as seen from x in double-double, relative to its terms (absolutely).
inline constexpr double kPlace = 0x1p-102;

/// |a| of a vector with components up to 1.
inline constexpr double kDiagonal = 2;

/// A single ball: s = v . d, and v x d, relative to |v| |d|; and the slack's own roundings, relative to
/// (r |v|)^2 + |v x d|^2.
inline constexpr double kLoneAlong = 6, kLoneAcross = 5, kLoneSlack = 8;

/// Rows beside a line: v x b and v . b, relative to |v| |b|, of a vector that is summed from two steps along
/// the basis; and per condition of the shape, where ellipsoids are seen as balls.
inline constexpr double kSparse = 10, kSparseOfShape = 16;

/// The height over a layer, and the speed towards it: relative to the sizes of the terms of a . (b_0 x b_1).
inline constexpr double kLayer = 8;

/// The error of a form of a vector (height, along, across in units of r), relative to that of each component.
inline constexpr double kForm = 4;

/// A vector of the short basis, relative to the largest of its terms, in units of u^2.
inline constexpr double kBasis = 32;

/// The error of a vector of the short basis, as the size of terms that would have this error at kAnchorTerms
/// each: terms of a height in 2D, and of the vector in 3D.
inline constexpr double kBasisInHeight = 0x1p108, kBasisInSize = 0x1p104;

/// The shape of an ellipsoid in double-double, in units of u^2: the adjugate of its semiaxes (relative to the
/// square of the longest), their determinant (to its cube), N, its square G, and the cofactors C.
inline constexpr double kAdjugate = 9, kDeterminant = 24, kToBall = 21, kMetric = 16, kCofactor = 24;

/// 2D, an ellipse of condition c: rho errs by kRho + kRhoOfShape c, and s by kAlongOfShape c, relative to |N|
/// |w| |d|.
inline constexpr double kRhoOfShape = 4, kAlongOfShape = 16;

/// The time (s - q) / v^2 in binary64, relative to s / v^2.
inline constexpr double kRoughTime = 16;

// ---- Widening of ranges -----------------------------------------------------------------------------------

/// 2D: numbers of rows, whose terms are below 2^20; other quotients, which are below 2^18.
inline constexpr double kRowSlop = 0x1p-28, kSlop2d = 0x1p-30;

/// 3D: every range of the enumeration; half of it is for what the anchor errs by, which is checked.
inline constexpr double kSlop3d = 0x1p-20;

/// 3D: of the half width of a section, which is a root, so that its square is compared.
inline constexpr double kSectionSlop = kSlop3d * kSlop3d;

/// How far an obstacle reaches in a cell (relative); and what is computed in a few roundings where more would
/// do no harm.
inline constexpr double kReachSlop = 0x1p-30, kAmple = 0x1p-40;

/// 3D, Newton's step to the entry of a line into the cylinder: not where it is so far that what the curvature
/// adds is above this, relative to the step; of which twice, and one more candidate on each side, are
/// granted.
inline constexpr double kEntryCurvature = 0x1p-7, kEntrySlop = 2;

// ---- No error bounds: no test derives them ----------------------------------------------------------------
//
// What is beyond a cap is `undecided` (or, of scenes, not done), and where one formula takes over from
// another both are right: a wrong value here costs answers or time, it does not make an answer wrong. Where a
// cap is what a bound above relies on, the line says so.

/// 3D: a lattice vector so short and so near to the line may lie with it in a plane of short lattice vectors.
inline constexpr double kShortVector = 0x1p8, kNearlyParallel = 0x1p-30;

/// Integers of the search, held in binary64: exact below this, and never used beyond.
inline constexpr double kMaxCoefficient = 0x1p53;

/// 3D: a vector whose across errs by more roundoffs of itself is computed without rounding.
inline constexpr double kFewCancel = 0x1p29;

/// Components of lattice vectors below this are taken as zero, so that no product with a velocity's
/// underflows. kFlushed relies on it: what that changes, times kMaxTransform of the short basis, over 2^53
/// cells.
inline constexpr double kTinyVectorComponent = 0x1p-480;

/// Cells whose short basis has larger coefficients are not done.
inline constexpr double kMaxTransform = 0x1p20;

/// The range of the first lattice's shortest vector, and of the others relative to it.
inline constexpr double kMaxLength = 0x1p400, kMaxSpacing = 0x1p60;

/// Radii, in units of the shortest lattice vector (of ellipsoids: both in the metric of their shape): at least
/// this, or numbers of cells leave the exact integers.
inline constexpr double kSmallestRadius2d = 1e-12, kSmallestRadius3d = 1e-7;

/// Obstacles of one lattice do not overlap, and so are entered in the order of their centres. Those of an atom that
/// do belong to several lattices, at most this number, whose vectors are multiples of the scene's.
inline constexpr int kMaxLatticesOfAtom = 64;

/// More slender ellipsoids are not done, nor larger or smaller ones, nor those whose metric errs by more than
/// this in the directions in which they are long: so that in binary64 its error never counts.
inline constexpr double kMaxCondition = 0x1p14, kMaxShapeRadius = 0x1p100, kMaxMetricError = 0x1p-62;

/// A start's coordinates from its home cell are within 1/2 and kMaxHomeError; scenes for which they are not
/// known so well for what lies within kHomeCell of each basis vector are not done.
inline constexpr double kMaxHomeError = 0x1p-12, kHomeCell = 0.6;

/// An obstacle that reaches less far into its cell contains no point of another's; if less far on the unit
/// lattice, one step along each axis finds it.
inline constexpr double kReachAtHome = 0.499, kReachOfAxes = 0.99;

/// Starts farther than this many cells from the atom's origin are not done (unit lattices: kMaxStart).
inline constexpr double kMaxGeneralStart = 0x1p44;

/// Added before a coordinate is rounded down to that of its home cell. Not 0.5, which takes 1/2 - 2^-54 to 1:
/// from there it would be seen with a rounding.
inline constexpr double kBelowHalf = 0x1.fffffffffffffp-2;

/// Cells that the search names, from the home cell; and those that it counts with where it leaves binary64.
inline constexpr double kMaxCell = 0x1p61, kMaxWideCell = 0x1p76;

/// `from` is not near x if its cell is beyond 2 to the first, or beyond 2 to the second from the home cell.
inline constexpr int kFarthestCellBits = 84, kFarthestHereBits = 77;

/// 2D: positive heights below this vanish when they are multiplied by the inverse of an area.
inline constexpr double kSmallestHeight = 0x1p-800;

/// 2D: below this rho positions are counted from an anchor near the start instead of the home cell.
inline constexpr double kRhoOfAnchor = 0x1p-20;

/// 2D: the low part of a height that Euclid's algorithm may leave aside until then, relative to the high one;
/// and the quotient of its last step where that is taken back for a shape.
inline constexpr double kMaxLowPart = 0x1p-8, kMaxBackwardQuotient = 0x1p40;

/// Rows whose direction across the line is known worse than this, relatively, count as parallel to it.
inline constexpr double kMaxGamma = 0x1p-10;

/// What a candidate's number may be unsure by before it is computed in double-double.
inline constexpr double kMaxUnsure = 0.25;

/// 2D: D_L is summed without rounding if its error, over the m that lead from one row to the next, is this part of
/// itself.
inline constexpr double kRoughHeight = 0x1p-10;

/// 3D: the expected number of obstacles in the first window; the longest jump, in windows; where in a window its
/// anchor is.
inline constexpr double kWindowCells = 2, kMaxJump = 0x1p70, kMiddle = 0.5;

/// 3D: how many times longer later windows are, at least; or how many cells of the lattice of lines they pass.
inline constexpr double kLonger = 4, kLinesInWindow = 0.125;

/// 3D: steps from an anchor to the next one; beyond kNearAnchor another step follows.
inline constexpr double kMaxAnchorStep = 0x1p60, kNearAnchor = 0x1p20;

/// 3D: a section with more lines is searched in parts; the first has at most this many cells; half of the
/// lines of a part.
inline constexpr double kManyLines = 12, kPartCells = 2, kMaxLinesInPart = 64;

/// 3D: shorter stretches of a line that binary64 does not resolve are walked, candidate by candidate; how far
/// Newton's step may be off in candidates.
inline constexpr double kShortStretch = 16, kMaxEntryError = 24;

/// 3D, running coordinates of a reduction err by their coefficients times the first rounding: beyond these
/// they are computed anew. kGoodRunning: coefficients times 1/r, for errors of 2^-12 in units of r, which is
/// kGoodPlace.
inline constexpr double kRunningCoefficient = 0x1p20, kRunningQuotient = 0x1p20, kNoLimit = 0x1p100,
                        kGoodRunning = 0x1p40, kGoodPlace = 0x1p-12;

/// 3D: a basis is nearly orthogonal if all |b_i| |dual_i| are at most this; then |b_0| |b_1| |b_2| / volume
/// is at most its square, on which kPlane relies. Both are at most sqrt(2) for reduced bases.
inline constexpr double kMaxDefect = 2.8;

/// Rounds of loops that end by themselves much earlier, or have found something hard.
inline constexpr int kMaxShorteningPasses = 1000, kMaxHomePasses = 8, kMaxRenormalisations = 8, kMaxRows = 64,
                     kMaxCandidatesInRow = 16, kMaxWindows = 200, kMaxAnchorPasses = 4,
                     kMaxCandidatesOnLine = 64, kMaxEntryPasses = 6, kMaxReductionRounds = 60,
                     kMaxReductionSteps = 300, kMaxPlaneReductionSteps = 200;

/// Many flights at once: below this radius times are rounded from the slack in binary64, if that suffices.
inline constexpr double kSoonRadius = 0x1p-5;

/// Times are s - q, where q is half the chord. In binary64: if s < kNear q, the difference would cancel, and
/// another formula is used. If the slack errs by more than kGrazing u q s (for ellipsoids of condition c:
/// (kGrazing + kGrazingOfShape c) u q s), or if c is above kSlender, double-double is used. In double-double:
/// if s < kNearWide q, the other formula is used; if s > kFarSlack q, one roundoff of q does not count.
inline constexpr double kNear = 4, kGrazing = 64, kGrazingOfShape = 32, kSlender = 6, kNearWide = 2,
                        kFarSlack = 0x1p14;

}  // namespace lorentz
