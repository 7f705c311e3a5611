// How many instructions this thread has executed, where the processor counts them and the system tells.
#pragma once

#include <cstdint>
#include <optional>

namespace lorentz::question {

class InstructionCounter {
 public:
  /// Counts nothing yet.
  InstructionCounter();
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  void resume();
  void pause();

  /// Of this thread, outside of the kernel, while it counted. Nothing where counting is not possible, or not
  /// allowed (Linux: /proc/sys/kernel/perf_event_paranoid above 2, a virtual machine without counters).
  std::optional<std::uint64_t> count() const;

 private:
  int file_ = -1;
};

}  // namespace lorentz::question
