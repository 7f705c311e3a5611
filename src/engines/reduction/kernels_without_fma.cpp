// The kernels for every processor.
#include "src/engines/reduction/scene_flight.hpp"

namespace lorentz {
namespace {

template <int D, SceneModel kModel, bool kBall>
void fly_split(const Task& task, Flight& flight) {
  fly_with<SplitProduct, D, kModel, kBall>(task, flight);
}

}  // namespace

FlightKernel kernel_without_fma(const PreparedScene& scene) {
  return for_scene(scene, []<int D, SceneModel kModel, bool kBall>() -> FlightKernel {
    return fly_split<D, kModel, kBall>;
  });
}

}  // namespace lorentz
