// Decides exactly whether two ellipsoids are apart, touch or overlap. Private to oracle/.
#pragma once

#include "oracle/integers/integer.hpp"

namespace lorentz::oracle {

enum class Relation { apart, touch, overlap };

/// A symmetric matrix.
template <std::size_t D>
using Form = std::array<ZVec<D>, D>;

/// adj(S), with S adj(S) = det(S) I.
template <std::size_t D>
Form<D> adjugate(const Form<D>& s);

template <std::size_t D>
Z determinant(const Form<D>& s);

/// The relation of the open ellipsoids { x : x.S1^-1 x < 1 } and { x : (x - c).S2^-1 (x - c) < 1 }, with S1
/// and S2 positive definite. (Semiaxes A give S = A A^T.)
template <std::size_t D>
Relation relation_of(const Form<D>& s1, const Form<D>& s2, const ZVec<D>& c);

}  // namespace lorentz::oracle
