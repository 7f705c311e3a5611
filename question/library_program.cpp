#include "question/command_engine.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>

// The program lorentz_library_host, as bytes, so that it is available wherever this library is: in a program
// or in Python. LORENTZ_LIBRARY_HOST is its file.
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
namespace {

// The program as a file without a name, which exists until this program ends. Its descriptor lies above those
// that a child has.
int host_descriptor(const std::string& engine) {
  static const int file = [&engine] {
    const int low = memfd_create("lorentz_library_host", MFD_CLOEXEC);
    const int descriptor = low < 0 ? -1 : fcntl(low, F_DUPFD_CLOEXEC, 10);
    if (descriptor < 0) {
      if (errno == EINVAL) errno = EMFILE;  // 10 is beyond the limit
      throw cannot_start(engine);
    }
    close(low);
    for (std::string_view bytes(lorentz_library_host_begin, lorentz_library_host_end); !bytes.empty();) {
      const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
      if (count <= 0) throw cannot_start(engine);
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return descriptor;
  }();
  return file;
}

}  // namespace

Executable library_program(const std::string& file, int threads, bool row_by_row) {
  const std::string name = "lib:" + file;
  // The system would look for a name without a slash among its own libraries.
  const std::string path = file.find('/') == std::string::npos ? "./" + file : file;
  return {name,
          fmt::format("/proc/self/fd/{}", host_descriptor(name)),
          {"lorentz_library_host", path, std::to_string(threads), row_by_row ? "1" : "8192"}};
}

}  // namespace lorentz::question
