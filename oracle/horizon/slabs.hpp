// The free slabs of a scene: strips in 2D, layers between lattice planes in 3D. Private to oracle/.
#pragma once

#include <string>
#include <vector>

#include <lorentz/horizon.hpp>
#include "oracle/horizon/channel_scene.hpp"

namespace lorentz::oracle {

/// { x : low + sqrt(low2) < normal.x < high - sqrt(high2) }, and its translates by the scene's periods.
template <std::size_t D>
struct Slab {
  ZVec<D> normal;
  Gap gap;
  Z count = 1;  ///< so many slabs in a period of the whole scene, of which this one is the widest
};

template <std::size_t D>
struct Slabs {
  std::vector<Slab<D>> open;
  std::vector<ZVec<D>> undecided;  ///< normals of which it is not known whether slabs are open
  std::string refusal;             ///< not empty: too many candidates, and this is the reason
};

/// All slabs, or those at least scene.unit wide if that is above 0.
template <std::size_t D>
Slabs<D> free_slabs(const ChannelScene<D>& scene, const SearchProgress& progress);

}  // namespace lorentz::oracle
