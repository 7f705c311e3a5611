// Velocities in lanes: ScaledVelocity of engine_base.hpp. Private to the batch engine.
#if defined(LORENTZ_BATCH_VELOCITY_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LORENTZ_BATCH_VELOCITY_INL_HPP
#undef LORENTZ_BATCH_VELOCITY_INL_HPP
#else
#define LORENTZ_BATCH_VELOCITY_INL_HPP
#endif

#include <lorentz/engine_base.hpp>
#include "src/engines/batch/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lorentz {
namespace HWY_NAMESPACE {
namespace {

/// Velocities scaled by powers of two, so that their largest components lie in [1, 2). Far from 1, or with
/// tiny components, they are left over.
template <int D>
struct Velocity {
  V scaled[D], factor;

  HWY_INLINE Velocity(const V (&v)[D], Lanes& lanes) {
    V top = Abs(v[0]);
    for (int k = 1; k < D; ++k) top = Max(top, Abs(v[k]));
    factor = inverse_power_of(top);
    lanes.leave_unless(And(top > all(0x1p-490), top < all(0x1p490)));
    for (int k = 0; k < D; ++k) {
      scaled[k] = v[k] * factor;
      lanes.leave(And(Abs(scaled[k]) < all(kTinyComponent), v[k] != none()));
      lanes.leave_unless(Abs(v[k]) <= top);  // not a number
    }
  }

  /// A time in the scaled units, in those of the query. Without rounding: lanes know no times but 0 and those from
  /// 2^-100 (they tell a start from its obstacle's surface to 2^-52 of a radius of 2^-40 or more) to 2^63, exponents
  /// are at most 400, and the factor is within 2^-490 and 2^490.
  template <bool kUnit>
  HWY_INLINE V time_of(V time, const PreparedScene& scene) const {
    if constexpr (!kUnit) time = time * all(scene.unit);
    return time * factor;
  }

  /// A limit of the query, in the scaled units.
  template <bool kUnit>
  HWY_INLINE V limit_of(V limit, const PreparedScene& scene) const {
    limit = limit * inverse_power_of(factor);
    return kUnit ? limit : limit * all(scene.inverse_unit);
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace lorentz
HWY_AFTER_NAMESPACE();

#endif
