// The kernels for scenes of balls in the plane.
#define LORENTZ_KERNELS kernels_of_balls_in_plane
#define LORENTZ_FLY fly_any<2, true>
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/engines/batch/kernels_balls_2d.cpp"
#include "src/engines/batch/kernels-inl.hpp"
