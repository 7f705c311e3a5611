// The kernels for scenes of ellipsoids in the plane.
#define LORENTZ_KERNELS kernels_of_ellipsoids_in_plane
#define LORENTZ_FLY fly_any<2, false>
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/engines/batch/kernels_ellipsoids_2d.cpp"
#include "src/engines/batch/kernels-inl.hpp"
