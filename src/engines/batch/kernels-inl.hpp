// The kernels for one kind of scene: LORENTZ_FLY, compiled once for each set of instructions that has a fused
// multiply-add, and LORENTZ_KERNELS, which lists them. (Without a fused multiply-add an exact product takes
// many operations, so lanes gain nothing, and single flights are used.) Each kind is a source file of its
// own, so that none takes long to compile.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <lorentz/engine_base.hpp>
#include "src/engines/batch/stretch.hpp"
#include "src/engines/reduction/bounds.hpp"
#include "src/engines/reduction/bravais.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_NATIVE_FMA
HWY_BEFORE_NAMESPACE();
namespace lorentz {
namespace HWY_NAMESPACE {
namespace {

// Each file needs those before it.
#include "src/engines/batch/native-inl.hpp"

#include "src/engines/batch/twin-inl.hpp"

#include "src/engines/batch/lanes-inl.hpp"

#include "src/engines/batch/lane_numbers-inl.hpp"

#include "src/engines/batch/start-inl.hpp"
#include "src/engines/batch/time-inl.hpp"
#include "src/engines/batch/turn-inl.hpp"
#include "src/engines/batch/velocity-inl.hpp"

#include "src/engines/batch/basis_3d-inl.hpp"
#include "src/engines/batch/late-inl.hpp"
#include "src/engines/batch/search_2d-inl.hpp"
#include "src/engines/batch/search_3d-inl.hpp"
#include "src/engines/batch/single_ball-inl.hpp"

#include "src/engines/batch/flight-inl.hpp"

#include "src/engines/batch/block-inl.hpp"

void fly(const PreparedScene& scene, Stretch& stretch) {
  LORENTZ_FLY(scene, stretch);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace lorentz
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace lorentz {

std::vector<BuiltKernel> LORENTZ_KERNELS() {
  std::vector<BuiltKernel> built;
#if HWY_TARGETS & HWY_AVX3
  built.push_back({HWY_AVX3, N_AVX3::fly});
#endif
#if HWY_TARGETS & HWY_AVX2
  built.push_back({HWY_AVX2, N_AVX2::fly});
#endif
#if HWY_TARGETS & HWY_NEON
  built.push_back({HWY_NEON, N_NEON::fly});
#endif
  return built;
}

}  // namespace lorentz
#endif
