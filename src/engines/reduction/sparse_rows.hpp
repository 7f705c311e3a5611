// Which obstacles of a row, and which rows of a plane, a line can meet, for one flight. Private to the
// reduction engine.
#pragma once

#include "src/engines/base/fma.hpp"
#include "src/engines/base/numbers.hpp"
#include "src/engines/reduction/bounds.hpp"
#include "src/engines/reduction/formulas.hpp"

namespace lorentz {

#define LORENTZ_INLINE inline
#include "src/engines/reduction/sparse_rows-inl.hpp"
#undef LORENTZ_INLINE

}  // namespace lorentz
