// The kernels for scenes of ellipsoids in space.
#define LORENTZ_KERNELS kernels_of_ellipsoids_in_space
#define LORENTZ_FLY fly_any<3, false>
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/engines/batch/kernels_ellipsoids_3d.cpp"
#include "src/engines/batch/kernels-inl.hpp"
