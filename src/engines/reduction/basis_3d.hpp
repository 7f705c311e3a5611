// Short bases of a 3D lattice as seen along a line, for one flight. Private to the reduction engine.
#pragma once

#include "src/engines/reduction/bounds.hpp"
#include "src/engines/reduction/formulas.hpp"

namespace lorentz {

#define LORENTZ_INLINE inline
#include "src/engines/reduction/basis_3d-inl.hpp"
#undef LORENTZ_INLINE

using Arm3 = ArmOf3<SplitProduct>;
using Basis3 = BasisOf3<SplitProduct>;

}  // namespace lorentz
