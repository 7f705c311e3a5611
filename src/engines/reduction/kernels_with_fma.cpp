// The kernels for processors with a fused multiply-add.
#include "src/engines/reduction/scene_flight.hpp"

namespace lorentz {
namespace {

template <int D, SceneModel kModel, bool kBall>
[[LORENTZ_WITH_FMA]] void fly_fma(const Task& task, Flight& flight) {
  fly_with<HardwareFma, D, kModel, kBall>(task, flight);
}

}  // namespace

FlightKernel kernel_with_fma(const PreparedScene& scene) {
  return for_scene(scene, []<int D, SceneModel kModel, bool kBall>() -> FlightKernel {
    return fly_fma<D, kModel, kBall>;
  });
}

}  // namespace lorentz
