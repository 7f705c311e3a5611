// The kernels for scenes of balls in space.
#define LORENTZ_KERNELS kernels_of_balls_in_space
#define LORENTZ_FLY fly_any<3, true>
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/engines/batch/kernels_balls_3d.cpp"
#include "src/engines/batch/kernels-inl.hpp"
