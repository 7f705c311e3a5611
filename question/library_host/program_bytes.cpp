#include "question/library_host/program_bytes.hpp"

// LORENTZ_LIBRARY_HOST is the program's file.
asm(".section .rodata\n"
    ".hidden lorentz_library_host_begin\n"
    ".global lorentz_library_host_begin\n"
    "lorentz_library_host_begin:\n"
    ".incbin \"" LORENTZ_LIBRARY_HOST
    "\"\n"
    ".hidden lorentz_library_host_end\n"
    ".global lorentz_library_host_end\n"
    "lorentz_library_host_end:\n"
    ".previous\n");

extern "C" {
extern const char lorentz_library_host_begin[], lorentz_library_host_end[];
}

namespace lorentz::question {

std::string_view library_host_program() {
  return {lorentz_library_host_begin,
          static_cast<std::size_t>(lorentz_library_host_end - lorentz_library_host_begin)};
}

}  // namespace lorentz::question
