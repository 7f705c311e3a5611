// One vector at a time. Included once for each set of instructions. Private to the batch engine.
#if defined(LORENTZ_BATCH_SINGLE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LORENTZ_BATCH_SINGLE_INL_HPP
#undef LORENTZ_BATCH_SINGLE_INL_HPP
#else
#define LORENTZ_BATCH_SINGLE_INL_HPP
#endif

#include "src/engines/batch/native-inl.hpp"

#if !LORENTZ_TWIN_LANES || HWY_TARGET == HWY_AVX3

HWY_BEFORE_NAMESPACE();
namespace lorentz {
namespace HWY_NAMESPACE {
namespace {

using V = N;
using M = NM;

constexpr std::size_t kLanes = kNativeLanes;

HWY_INLINE V all(double a) {
  return Set(kTag, a);
}
HWY_INLINE M no_lane() {
  return MaskFromVec(Zero(kTag));
}
HWY_INLINE bool nowhere(M m) {
  return AllFalse(kTag, m);
}
HWY_INLINE M first_lanes(std::size_t count) {
  return first_native(count);
}
HWY_INLINE V load(const double* from) {
  return load_native(from);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace lorentz
HWY_AFTER_NAMESPACE();
#endif

#endif
