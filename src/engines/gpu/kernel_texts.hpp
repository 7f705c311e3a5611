// The kernels that were made when the program was built (packaging/cmake/LorentzGpu.cmake).
#pragma once

#include <map>
#include <string>

namespace lorentz::gpu {

/// Kernels as PTX, by the kinds of scenes (kinds.inc). Empty if the build has none.
using KernelTexts = std::map<std::string, const char*>;

/// Those that fly queries in columns.
const KernelTexts& column_kernels();

}  // namespace lorentz::gpu
