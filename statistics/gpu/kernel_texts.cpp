#include "statistics/gpu/kernel_texts.hpp"

#define LORENTZ_TEXT(name)                                                                               \
  asm(".section .rodata\n.globl lorentz_kernel_" #name "\n.hidden lorentz_kernel_" #name                 \
      "\nlorentz_kernel_" #name ":\n.incbin \"" LORENTZ_TEXTS "/" #name ".ptx\"\n.byte 0\n.previous\n"); \
  extern "C" [[gnu::visibility("hidden")]] const char lorentz_kernel_##name[];
#include "statistics/gpu/kernel_texts.inc"
#undef LORENTZ_TEXT

namespace lorentz::gpu {

const std::vector<KernelText>& kernel_texts() {
  static const std::vector<KernelText> all{
#define LORENTZ_TEXT(name) {#name, lorentz_kernel_##name},
#include "statistics/gpu/kernel_texts.inc"
#undef LORENTZ_TEXT
  };
  return all;
}

}  // namespace lorentz::gpu
