// The kernels for every processor, and how directions are prepared.
#include "src/engines/reduction/scene_flight.hpp"

namespace lorentz {
namespace {

template <int D, SceneModel kModel, bool kBall>
void fly_split(const Task& task, Flight& flight) {
  fly_with<SplitProduct, D, kModel, kBall>(task, flight);
}

template <int D, SceneModel kModel, bool kBall>
std::shared_ptr<const AtomDirections> directions_for(const PreparedScene& scene, const Vec& v) {
  using Item = typename AtomFlight<SplitProduct, D, kModel, kBall>::Direction;
  auto directions = std::make_shared<DirectionsOfModel<Item>>();
  // Each is set from the one before, as in fly_several, so that both decide alike, to the bit.
  std::optional<Item> to;
  const Bravais* before = nullptr;
  for (const Bravais& lattice : scene.atoms) {
    Item::set(to, SplitProduct{}, before, lattice, v);
    directions->items.push_back(*to);
    before = &lattice;
  }
  return directions;
}

}  // namespace

Kernels kernels_without_fma(const PreparedScene& scene) {
  return for_scene(scene, []<int D, SceneModel kModel, bool kBall>() -> Kernels {
    return {fly_split<D, kModel, kBall>, directions_for<D, kModel, kBall>};
  });
}

}  // namespace lorentz
