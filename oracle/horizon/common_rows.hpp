// The directions in which each of two lattices of the plane has rows so far apart that it may leave a way
// between them. Private to oracle/.
#pragma once

#include <optional>
#include <vector>

#include "oracle/horizon/channel_scene.hpp"

namespace lorentz::oracle {

/// The normals, up to a factor, along which both lattices have gaps, and perhaps further normals: at most
/// two. Nothing if there may be many, because the lattices are commensurable or the obstacles large.
std::optional<std::vector<ZVec<2>>> common_normals(const ObstacleLattice<2>& a, const ObstacleLattice<2>& b);

}  // namespace lorentz::oracle
