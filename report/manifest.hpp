// What the numbers of a report depend on besides the scenes and queries: the program, and the machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lorentz::report {

struct Manifest {
  std::string version;       ///< of lorentz
  std::string commit;        ///< of the sources, "-dirty" if they were changed since; "unknown" without git
  std::string compiler;      ///< and its version
  std::string flags;         ///< what everything was compiled with
  std::string machine;       ///< the processor, and how many threads it runs at a time
  std::string instructions;  ///< the vector instructions that batches use here
  std::string system;        ///< kernel and architecture
  std::string date;          ///< on which the run began, UTC
  std::uint64_t seed = 0;    ///< of all that was drawn
  std::string command;       ///< the shell line that was typed
};

/// Of this program, on this machine, today.
Manifest manifest_of(std::uint64_t seed, std::string command);

/// An object, its keys as the members are called. A seed beyond 2^53 becomes a string.
void append_json(std::string& out, const Manifest& manifest);

}  // namespace lorentz::report
