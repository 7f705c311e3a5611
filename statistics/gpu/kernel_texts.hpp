// The kernels that were made when the program was built.
#pragma once

#include <vector>

namespace lorentz::gpu {

/// The kernels of this build, as PTX; empty if it has none.
struct KernelText {
  const char *name, *text;
};
const std::vector<KernelText>& kernel_texts();

}  // namespace lorentz::gpu
