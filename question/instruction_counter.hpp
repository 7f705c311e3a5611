// Counts the instructions that this thread executes, if the processor counts them and the system reports
// them.
#pragma once

#include <cstdint>
#include <optional>

namespace lorentz::question {

class InstructionCounter {
 public:
  /// Does not count yet.
  InstructionCounter();
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  void resume();
  void pause();

  /// The instructions of this thread, outside the kernel, while it counted. Nothing if counting is not
  /// possible or not allowed (Linux: /proc/sys/kernel/perf_event_paranoid above 2, a virtual machine without
  /// counters).
  std::optional<std::uint64_t> count() const;

 private:
  int file_ = -1;
};

}  // namespace lorentz::question
