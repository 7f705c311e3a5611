// A 3D lattice seen along one direction (direction_3d-inl.hpp says how). Private to the reduction engine.
#pragma once

#include "src/engines/reduction/frame_3d.hpp"
#include "src/engines/reduction/reduce_3d.hpp"

namespace lorentz {

/// Reduces the basis to short vectors, then once more from exact coefficients. False if this does not
/// succeed.
template <class Arch, class Frame>
bool reduce_basis(const Frame& frame, Basis3& basis, bool) {
  GreedyReduction reduction(basis);
  bool done = false;
  for (int round = 0; round < kMaxReductionRounds && !done; ++round) {
    done = reduction.run() && reduction.is_accurate(frame.inverse_r);
    for (Arm3& arm : basis.b) frame.template recompute<Arch>(arm, basis.length);
    reduction.refresh();
  }
  return done && reduction.largest() < kMaxCoefficient / 2;
}

#define LORENTZ_INLINE inline
#include "src/engines/reduction/direction_3d-inl.hpp"
#undef LORENTZ_INLINE

template <bool kUnit, bool kBall>
using Direction3 = DirectionOf3<SplitProduct, kUnit, kBall>;

}  // namespace lorentz
