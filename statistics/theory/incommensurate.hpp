// Whether lattices are commensurable. All binary64 numbers are rational, so all lattices are commensurable on
// a large enough scale. These functions test whether small integers show it. Private to statistics/theory.
#pragma once

#include <optional>

#include <lorentz/scene.hpp>

namespace lorentz::flights {

/// Coincidences are searched among fractions with denominators up to kMostDenominator, with the relative
/// tolerance kCoincidence. This is far more than the rounding error of a true coincidence, and so small that
/// random lattices meet it once in 10^14.
inline constexpr int kMostDenominator = 1000;
inline constexpr double kCoincidence = 1e-9;

/// Whether the lattices share a sublattice after one of them is scaled by some real factor. If so, short
/// paths in one lattice are correlated with paths in the other, however small the obstacles are.
bool commensurable(const Lattice& a, const Lattice& b, int dimension);

/// Whether a point that moves through space takes independent positions in the cells of the lattices. It does
/// if reciprocal vectors, one from each lattice and not all zero, never add up to zero. The test covers the
/// vectors of two and of three lattices with small indices, and takes a second for kMostLattices.
inline constexpr std::size_t kMostLattices = 24;
bool independent(const Scene& scene);

/// The angle, in radians, between channels that each lattice alone leaves open, if they are parallel up to
/// kCoincidence but not exactly; else empty. Paths may then be as long as in an open corridor, up to about a
/// width divided by that angle. This happens when lattices that share a direction are rotated by rounded
/// numbers. Only channels with small indices are examined.
std::optional<double> nearly_common_way(const Scene& scene);

}  // namespace lorentz::flights
