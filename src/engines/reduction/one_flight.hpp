// The code that both fast engines share, for one flight: a number is a double, a mask a bool. Private to the
// reduction engine.
#pragma once

#include <type_traits>

#include <lorentz/engine_base.hpp>
#include "src/engines/base/double_double.hpp"
#include "src/engines/reduction/bounds.hpp"
#include "src/engines/reduction/bravais.hpp"
#include "src/engines/reduction/formulas.hpp"

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
#define LORENTZ_NOINLINE [[gnu::noinline]]
#define LORENTZ_RARE [[gnu::noinline]]
#include "src/engines/reduction/shared-inl.hpp"
#undef LORENTZ_RARE
#undef LORENTZ_NOINLINE
#undef LORENTZ_INLINE

using Arm3 = ArmOf3<SplitProduct>;
using Basis3 = BasisOf3<SplitProduct>;
using Point3 = PointOf3<SplitProduct>;

template <bool kUnit, bool kBall>
using Direction3 = DirectionOf3<SplitProduct, kUnit, kBall>;

}  // namespace lorentz
