// The formulas whose rounding errors decide, for one flight.
#pragma once

#include "src/engines/base/numbers.hpp"

namespace lorentz {

#define LORENTZ_INLINE inline
#include "src/engines/reduction/formulas-inl.hpp"
#undef LORENTZ_INLINE

}  // namespace lorentz
