// Do lattices keep step with each other? Numbers in binary64 are rational, so all lattices do, if one looks
// far enough: what is asked is whether small integers show it. Private to statistics/theory.
#pragma once

#include <optional>

#include <lorentz/scene.hpp>

namespace lorentz::flights {

/// Coincidences are looked for among fractions with denominators up to kMostDenominator, to kCoincidence of
/// the whole: far more than rounding leaves of one, and so little that lattices drawn at random meet it once
/// in 10^14.
inline constexpr int kMostDenominator = 1000;
inline constexpr double kCoincidence = 1e-9;

/// Is some multiple of one lattice, by any real factor, in part the other: do they share a sublattice? That
/// is what lets short paths in one tell of paths in the other, however small the obstacles are.
bool commensurable(const Lattice& a, const Lattice& b, int dimension);

/// Are the places that a point takes in the cells of the lattices independent, as the point goes through
/// space? They are if reciprocal vectors, one a lattice and not all zero, never add up to zero; tried are
/// those of two lattices, and of three, with small indices.
bool independent(const Scene& scene);

/// Do ways that every lattice leaves open on its own lie in nearly one direction, to kCoincidence, but not
/// exactly? Then paths may be as long as if a corridor were open, up to about a width over that angle: turned
/// by rounded numbers, lattices that share a direction share it nearly. The angle, in radians; of ways with
/// small indices.
std::optional<double> nearly_common_way(const Scene& scene);

}  // namespace lorentz::flights
