#include "tests/harness/input_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>

#include "tests/harness/harness.hpp"

namespace lorentz::harness {

BytesAsFile::BytesAsFile() : descriptor_(memfd_create("input", MFD_CLOEXEC)) {
  if (descriptor_ < 0) fail("a file in memory can be made", "memfd_create failed");
  path_ = "/proc/self/fd/" + std::to_string(descriptor_);
}

BytesAsFile::~BytesAsFile() {
  close(descriptor_);
}

void BytesAsFile::set(std::string_view content) {
  const auto size = static_cast<ssize_t>(content.size());
  if (ftruncate(descriptor_, size) != 0 || pwrite(descriptor_, content.data(), content.size(), 0) != size)
    fail("a file in memory can be written", path_);
}

LoneLine::LoneLine(std::string_view text, std::size_t number)
    : bytes_(new char[text.size() + LineReader::kPadding]()),
      line_{std::string_view(bytes_.get(), text.size()), number, false} {
  std::copy(text.begin(), text.end(), bytes_.get());
}

}  // namespace lorentz::harness
