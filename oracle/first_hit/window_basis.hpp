// A lattice basis that is short for a window of the flight, 3D. Private to oracle/.
//
// The form 4^j |h|^2 + s^2 (window_form) makes a window of about 2^(j+1) rho of the cylinder round. The basis
// is reduced under this form, and from one window to the next only a few steps are needed. The steps are
// found in binary64, from the rounded h and s of the vectors, but done on the integers. So whatever the
// rounding, the result is a basis of the same lattice, and a worse basis costs time, never an obstacle.
#pragma once

#include "oracle/exact/planes.hpp"

namespace lorentz::oracle {

class WindowBasis {
 public:
  WindowBasis(const ExactVelocity<3>& velocity, const Basis<3>& basis);

  /// Makes the basis short for windows of about 2^(j+1) rho. Returns false if it stays as it was.
  bool shorten(long j);

  /// Shortest first.
  const LatticePoint<3>& operator[](std::size_t i) const { return vectors_[order_[i]].point; }

 private:
  struct BasisVector : WindowVector {
    ZVec<3> h;
    void add_multiple(const Z& k, const BasisVector& other);
  };
  /// 2^j h and s of the vectors, times one power of two, rounded.
  using Rounded = std::array<std::array<double, 4>, 3>;
  enum class Step { none, done, out_of_range };

  Rounded rounded(long j) const;
  Step shorten(Rounded& vectors);
  Step take(Rounded& vectors, std::size_t from, std::size_t a, double k, std::size_t b, double m);

  const ExactVelocity<3>& velocity_;
  std::array<BasisVector, 3> vectors_;
  std::array<std::size_t, 3> order_{0, 1, 2};
};

}  // namespace lorentz::oracle
