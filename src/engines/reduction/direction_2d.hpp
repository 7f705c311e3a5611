// A 2D lattice seen along one direction (direction_2d-inl.hpp says how). Private to the reduction engine.
#pragma once

#include "src/engines/reduction/formulas.hpp"
#include "src/engines/reduction/offset.hpp"

namespace lorentz {

#define LORENTZ_INLINE inline
#include "src/engines/reduction/direction_2d-inl.hpp"
#undef LORENTZ_INLINE

}  // namespace lorentz
