// The kernels for scenes of balls in lattices with fewer vectors than dimensions.
#define LORENTZ_KERNELS kernels_of_sparse_balls
#define LORENTZ_FLY fly_sparse
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/engines/batch/kernels_sparse_balls.cpp"
#include "src/engines/batch/kernels-inl.hpp"
