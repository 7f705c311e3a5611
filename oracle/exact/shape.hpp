// A A^T: the shape of an ellipsoid { p + A y : |y| < 1 }, whatever its centre and however its axes are
// written. Semiaxes in another order, with other signs, or otherwise turned among themselves give another A
// (A Q, Q orthogonal) of the same shape. Private to oracle/.
#pragma once

#include <optional>

#include "oracle/exact/exact_problem.hpp"

namespace lorentz::oracle {

template <std::size_t D>
ZMatrix<D> multiple_of_identity(const Z& factor) {
  ZMatrix<D> result;
  for (std::size_t i = 0; i < D; ++i) result[i][i] = factor;
  return result;
}

/// The columns of A.
template <std::size_t D>
ZMatrix<D> axes_of(const typename IntegerScene<D>::Atom& atom) {
  return atom.semiaxes ? *atom.semiaxes : multiple_of_identity<D>(atom.radius);
}

/// A A^T, with `axes` the columns of A. Two ellipsoids have equal shapes iff one is a translate of the other.
template <std::size_t D>
ZMatrix<D> shape_of(const ZMatrix<D>& axes) {
  ZMatrix<D> shape;
  for (const ZVec<D>& axis : axes)
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t k = 0; k < D; ++k) shape[i][k] += axis[i] * axis[k];
  return shape;
}

/// The radius, if this is the shape of a ball whose radius is an integer. (In 3D every ball's radius is one,
/// because its square and its cube, |det A|, are integers.)
template <std::size_t D>
std::optional<Z> ball_radius(const ZMatrix<D>& shape) {
  const Z& square = shape[0][0];
  if (shape != multiple_of_identity<D>(square)) return std::nullopt;
  const Z root = floor_sqrt(square);
  return root * root == square ? std::optional<Z>(root) : std::nullopt;
}

}  // namespace lorentz::oracle
