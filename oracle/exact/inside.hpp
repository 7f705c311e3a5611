// Lattice points in an open ball around x, exactly: they tell whether the particle is inside an obstacle.
// Private to oracle/.
#pragma once

#include <functional>
#include <optional>

#include "oracle/exact/exact_problem.hpp"

namespace lorentz::oracle {

/// Visits the points offset + k_1 b_1 + .. + k_D b_D in the open ball |c|^2 < radius2 row by row, with k_D
/// outermost and ascending. A row is given as its first point, the step b_1, and the last index. Stops when
/// the visitor returns true.
template <std::size_t D>
using RowVisitor =
    std::function<bool(const LatticePoint<D>& first, const LatticePoint<D>& step, const Z& last)>;

template <std::size_t D>
bool visit_ball(const Basis<D>& basis, const LatticePoint<D>& offset, const Z& radius2,
                const RowVisitor<D>& visit);

/// The smallest n, in lexicographic order, of the obstacles other than `from` that contain x.
template <std::size_t D>
std::optional<ZVec<D>> smallest_inside(const ExactScene<D>& scene, int lattice, int atom, const View<D>& view,
                                       const ZVec<D>* from, long exponent);

}  // namespace lorentz::oracle
