// One obstacle and the line, in double-double, for one flight.
#pragma once

#include <lorentz/vec.hpp>
#include "src/engines/base/double_double.hpp"
#include "src/engines/reduction/bounds.hpp"
#include "src/engines/reduction/bravais.hpp"
#include "src/engines/reduction/formulas.hpp"

namespace lorentz {

#define LORENTZ_INLINE inline
#include "src/engines/reduction/stable_meeting-inl.hpp"
#undef LORENTZ_INLINE

}  // namespace lorentz
