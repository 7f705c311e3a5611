// Numbers with twice the precision of binary64, one at a time.
#pragma once

#include "src/engines/base/numbers.hpp"

namespace lorentz {

#define LORENTZ_INLINE inline
#include "src/engines/base/double_double-inl.hpp"
#undef LORENTZ_INLINE

/// For code that need not be fast.
using Wide = DoubleDouble<SplitProduct>;

}  // namespace lorentz
