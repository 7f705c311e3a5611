// Channels along lines that lie in no planar channel. Private to oracle/.
#pragma once

#include <lorentz/horizon.hpp>
#include "oracle/horizon/channel_scene.hpp"

namespace lorentz::oracle {

/// Sets horizon.cylinders, families and no_cylinders.
void find_cylinders(const ChannelScene<3>& scene, Horizon& horizon, const SearchProgress& progress);

}  // namespace lorentz::oracle
