// The code that both fast engines share, for one flight: a number is a double, a mask a bool. Private to the
// reduction engine.
#pragma once

#include <type_traits>

#include <lorentz/engine_base.hpp>
#include "src/engines/base/double_double.hpp"
#include "src/engines/reduction/bounds.hpp"
#include "src/engines/reduction/bravais.hpp"
#include "src/engines/reduction/formulas.hpp"

namespace lorentz {

#define LORENTZ_INLINE inline
#define LORENTZ_NOINLINE [[gnu::noinline]]
#define LORENTZ_RARE [[gnu::noinline]]
#include "src/engines/reduction/shared-inl.hpp"
#undef LORENTZ_RARE
#undef LORENTZ_NOINLINE
#undef LORENTZ_INLINE

using Arm3 = ArmOf3<SplitProduct>;
using Basis3 = BasisOf3<SplitProduct>;
using Point3 = PointOf3<SplitProduct>;

template <bool kUnit, bool kBall>
using Direction3 = DirectionOf3<SplitProduct, kUnit, kBall>;

}  // namespace lorentz
