// One flight in each thread: the code of src/engines/batch with lanes of one number. Private to the engine on
// graphics cards, whose kernels include it, and everything that it includes.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <lorentz/engine_base.hpp>
#include "src/engines/base/double_double.hpp"
#include "src/engines/reduction/bounds.hpp"
#include "src/engines/reduction/bravais.hpp"

#define HWY_INLINE inline __attribute__((always_inline))
#define HWY_NOINLINE __attribute__((noinline))
#define HWY_LIKELY(a) __builtin_expect(!!(a), 1)
#define HWY_UNLIKELY(a) __builtin_expect(!!(a), 0)

namespace lorentz::device {

// Each file needs those before it.
#include "src/engines/gpu/one_lane-inl.hpp"

#include "src/engines/batch/lane_numbers-inl.hpp"

#include "src/engines/batch/start-inl.hpp"
#include "src/engines/batch/time-inl.hpp"
#include "src/engines/batch/turn-inl.hpp"
#include "src/engines/batch/velocity-inl.hpp"

#include "src/engines/batch/basis_3d-inl.hpp"
#include "src/engines/batch/search_2d-inl.hpp"
#include "src/engines/batch/search_3d-inl.hpp"
#include "src/engines/batch/single_ball-inl.hpp"

#include "src/engines/batch/flight-inl.hpp"

/// The atoms of a scene, in the card's memory. kOne: there is one.
template <bool kOneAtom>
struct Atoms {
  static constexpr bool kOne = kOneAtom;

  const Bravais* atoms;
  std::uint64_t count;
  double unit, inverse_unit;

  HWY_INLINE std::size_t size() const { return kOne ? 1 : count; }
  HWY_INLINE const Bravais& operator[](std::size_t a) const { return atoms[a]; }
};

/// Flights without limits, from no obstacle, with rounded times.
template <int D, bool kUnit, bool kBall>
struct Plain {
  static constexpr bool wants_rounded() { return true; }
  static constexpr bool is_limited() { return false; }
  static HWY_INLINE V limit() { return infinite(); }
  static constexpr bool find_leaving(const Start<D, kUnit, kBall>&, Leaving<D>&) { return false; }
  static constexpr bool put_off(M, const LaneEntry<D, kBall>&) { return false; }
};

template <int D, bool kUnit, bool kBall, bool kOneAtom>
using OneFlight = LaneFlight<D, kUnit, kBall, false, Atoms<kOneAtom>, Plain<D, kUnit, kBall>>;

#undef HWY_INLINE
#undef HWY_NOINLINE
#undef HWY_LIKELY
#undef HWY_UNLIKELY

}  // namespace lorentz::device
