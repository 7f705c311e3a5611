// Which sets of vector instructions there are.
#include <hwy/highway.h>
#include <hwy/targets.h>

#include "src/engines/batch/stretch.hpp"

namespace lorentz {

std::vector<StretchKernels> stretch_kernels() {
  const std::vector<BuiltKernel> plane = kernels_in_plane(), space = kernels_in_space();
  std::vector<StretchKernels> kernels;
  for (std::size_t i = 0; i < plane.size(); ++i)
    if ((hwy::SupportedTargets() & plane[i].target) != 0)
      kernels.push_back({hwy::TargetName(plane[i].target), plane[i].kernel, space[i].kernel});
  kernels.push_back({"none", nullptr, nullptr});
  return kernels;
}

std::string batch_libraries() {
  return "Highway " + std::to_string(HWY_MAJOR) + '.' + std::to_string(HWY_MINOR) + '.' +
         std::to_string(HWY_PATCH);
}

}  // namespace lorentz
