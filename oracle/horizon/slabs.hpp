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
  Z count = 1;  ///< the number of slabs in a period of the whole scene; this one is the widest of them
};

template <std::size_t D>
struct Slabs {
  std::vector<Slab<D>> open;
  std::vector<ZVec<D>> undecided;  ///< normals for which it is not known whether slabs are open
  std::string refusal;             ///< not empty if there are too many candidates; the reason
};

/// All slabs; if scene.unit is above 0, only those at least that wide.
template <std::size_t D>
Slabs<D> free_slabs(const ChannelScene<D>& scene, const SearchProgress& progress);

}  // namespace lorentz::oracle
