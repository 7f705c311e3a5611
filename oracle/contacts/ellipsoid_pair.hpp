// Decides exactly whether two ellipsoids are apart, touch or overlap. Private to oracle/.
#pragma once

#include "oracle/exact/exact_problem.hpp"

namespace lorentz::oracle {

enum class Relation { apart, touch, overlap };

/// The relation of the open ellipsoids { x : x.S1^-1 x < 1 } and { x : (x - c).S2^-1 (x - c) < 1 }, with S1
/// and S2 positive definite. (Semiaxes A give S = A A^T.)
template <std::size_t D>
Relation relation_of(const ZMatrix<D>& s1, const ZMatrix<D>& s2, const ZVec<D>& c);

}  // namespace lorentz::oracle
