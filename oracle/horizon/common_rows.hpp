// In which directions have two lattices of the plane rows so far apart that either may leave a way between?
// Private to oracle/.
#pragma once

#include <optional>
#include <vector>

#include "oracle/horizon/channel_scene.hpp"

namespace lorentz::oracle {

/// The normals, but for a factor, along which both lattices have gaps, and perhaps some more: at most two.
/// Nothing where there may be many, the lattices being commensurable or the obstacles large.
std::optional<std::vector<ZVec<2>>> common_normals(const ObstacleLattice<2>& a, const ObstacleLattice<2>& b);

}  // namespace lorentz::oracle
