// One atom's lattice seen along a velocity. Private to the reduction engine.
#pragma once

#include <algorithm>
#include <optional>

#include "src/engines/reduction/offset.hpp"
#include "src/engines/reduction/reduce_3d.hpp"

namespace lorentz {

/// The unit lattices of balls are turned so that the velocity lies in the first octant.
template <int D, bool kUnit, bool kBall>
struct AtomDirection {
  Octant octant;
  std::conditional_t<D == 2, Direction2<SplitProduct, kUnit, kBall>, Direction3<kUnit, kBall>> direction;

  template <class Arch>
  AtomDirection(Arch, const Bravais& lattice, const Vec& v)
      : octant(kUnit && kBall ? Octant(D, v) : Octant()) {
    Vec turned;
    octant.turn<kUnit && kBall>(v, turned);
    if constexpr (D == 2)
      direction.template set<Arch>(lattice, {turned[0], turned[1]}, true);
    else
      direction.template set<Arch>(lattice, {turned[0], turned[1], turned[2]}, true);
  }

  /// Sets `to` for the next atom along the same velocity, starting from that of the atom `before`.
  template <class Arch>
  static void set(std::optional<AtomDirection>& to, Arch arch, const Bravais* before, const Bravais& lattice,
                  const Vec& v) {
    const bool same_lattice =
        before && before->lattice == lattice.lattice && std::ranges::equal(before->stride, lattice.stride);
    if (same_lattice && before->radius == lattice.radius && (kBall || before->shape == lattice.shape)) return;
    if constexpr (D == 3 && kBall)
      if (same_lattice) return to->direction.template retarget<Arch>(lattice, true);
    to.emplace(arch, lattice, v);
  }
};

}  // namespace lorentz
