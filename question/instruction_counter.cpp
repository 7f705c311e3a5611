#include "question/instruction_counter.hpp"

#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace lorentz::question {

InstructionCounter::InstructionCounter() {
  perf_event_attr what{};
  what.size = sizeof what;
  what.type = PERF_TYPE_HARDWARE;
  what.config = PERF_COUNT_HW_INSTRUCTIONS;
  what.disabled = 1;
  what.exclude_kernel = 1;
  what.exclude_hv = 1;
  file_ = static_cast<int>(syscall(SYS_perf_event_open, &what, 0, -1, -1, PERF_FLAG_FD_CLOEXEC));
}

InstructionCounter::~InstructionCounter() {
  if (file_ >= 0) close(file_);
}

void InstructionCounter::resume() {
  if (file_ >= 0) ioctl(file_, PERF_EVENT_IOC_ENABLE, 0);
}

void InstructionCounter::pause() {
  if (file_ >= 0) ioctl(file_, PERF_EVENT_IOC_DISABLE, 0);
}

std::optional<std::uint64_t> InstructionCounter::count() const {
  std::uint64_t counted = 0;
  if (file_ < 0 || read(file_, &counted, sizeof counted) != sizeof counted || counted == 0)
    return std::nullopt;
  return counted;
}

}  // namespace lorentz::question
