// A point or direction.
#pragma once

#include <array>

namespace lorentz {

/// A point or direction, Cartesian. A 2D problem uses the first two components and keeps the third at zero.
using Vec = std::array<double, 3>;

}  // namespace lorentz
