// The kernels of 2D scenes, once for each set of instructions that has a fused multiply-add. (Without one an
// exact product takes many operations: there lanes gain nothing, and single flights are asked.)
#include "src/engines/batch/stretch.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/engines/batch/kernels_2d.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_NATIVE_FMA
#include "src/engines/batch/block-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lorentz {
namespace HWY_NAMESPACE {
namespace {

void fly_in_plane(const PreparedScene& scene, Stretch& stretch) {
  fly_any<2>(scene, stretch);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace lorentz
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace lorentz {

std::vector<BuiltKernel> kernels_in_plane() {
  std::vector<BuiltKernel> built;
#if HWY_TARGETS & HWY_AVX3
  built.push_back({HWY_AVX3, N_AVX3::fly_in_plane});
#endif
#if HWY_TARGETS & HWY_AVX2
  built.push_back({HWY_AVX2, N_AVX2::fly_in_plane});
#endif
#if HWY_TARGETS & HWY_NEON
  built.push_back({HWY_NEON, N_NEON::fly_in_plane});
#endif
  return built;
}

}  // namespace lorentz
#endif
