// The sets of vector instructions that the program can use.
#include <hwy/highway.h>
#include <hwy/targets.h>

#include "src/engines/batch/stretch.hpp"

namespace lorentz {

std::vector<StretchKernels> stretch_kernels() {
  const std::vector<BuiltKernel> discs = kernels_of_balls_in_plane(), balls = kernels_of_balls_in_space(),
                                 ellipses = kernels_of_ellipsoids_in_plane(),
                                 ellipsoids = kernels_of_ellipsoids_in_space();
  std::vector<StretchKernels> kernels;
  for (std::size_t i = 0; i < discs.size(); ++i)
    if ((hwy::SupportedTargets() & discs[i].target) != 0)
      kernels.push_back({hwy::TargetName(discs[i].target),
                         {discs[i].kernel, balls[i].kernel},
                         {ellipses[i].kernel, ellipsoids[i].kernel}});
  kernels.push_back({"none", {}, {}});
  return kernels;
}

std::string batch_libraries() {
  return "Highway " + std::to_string(HWY_MAJOR) + '.' + std::to_string(HWY_MINOR) + '.' +
         std::to_string(HWY_PATCH);
}

}  // namespace lorentz
