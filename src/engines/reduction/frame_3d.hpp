// Coordinates of a 3D lattice as seen along a velocity, for one flight. Private to the reduction engine.
#pragma once

#include "src/engines/reduction/basis_3d.hpp"
#include "src/engines/reduction/formulas.hpp"
#include "src/engines/reduction/offset.hpp"

namespace lorentz {

/// The axes in an order in which the smallest component of a vector is the last, c, and a and b follow it in
/// cyclic order. In the first octant the order stays.
template <class Numbers, bool kTurned>
class AxesOf {
 public:
  explicit AxesOf(const double (&w)[3]) {
    if constexpr (!kTurned) {
      c_ = 0;
      for (int i = 1; i < 3; ++i)
        if (std::fabs(w[i]) < std::fabs(w[c_])) c_ = i;
    }
  }
  double a(const double (&w)[3]) const { return w[(c_ + 1) % 3]; }
  double b(const double (&w)[3]) const { return w[(c_ + 2) % 3]; }
  double c(const double (&w)[3]) const { return w[c_]; }
  template <class T>
  void put(T (&to)[3], const T& a, const T& b, const T& c) const {
    to[(c_ + 1) % 3] = a, to[(c_ + 2) % 3] = b, to[c_] = c;
  }

 private:
  int c_ = 2;
};

#define LORENTZ_INLINE inline
#include "src/engines/reduction/frame_3d-inl.hpp"
#undef LORENTZ_INLINE

template <bool kUnit, bool kBall>
using Frame3 = FrameOf3<SplitProduct, kUnit, kBall>;

}  // namespace lorentz
