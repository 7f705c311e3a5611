// The kernels of scenes of single balls.
#define LORENTZ_KERNELS kernels_of_lone_balls
#define LORENTZ_FLY fly_lone
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/engines/batch/kernels_lone_balls.cpp"
#include "src/engines/batch/kernels-inl.hpp"
