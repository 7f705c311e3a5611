// The program and the machine, on which the numbers of a report depend besides the scenes and queries.
#pragma once

#include <cstdint>
#include <string>

namespace lorentz::report {

struct Manifest {
  std::string version;       ///< of lorentz
  std::string commit;        ///< of the sources, "-dirty" if they were changed since; "unknown" without git
  std::string compiler;      ///< with its version
  std::string flags;         ///< the compiler flags
  std::string machine;       ///< the processor, and how many threads it runs at a time
  std::string instructions;  ///< the vector instructions that batches use here
  std::string system;        ///< kernel and architecture
  std::string date;          ///< on which the run began, UTC
  std::uint64_t seed = 0;    ///< of all random draws
  std::string command;       ///< the shell line as typed
};

/// The manifest of this program, on this machine, today.
Manifest manifest_of(std::uint64_t seed, std::string command);

/// An object; the keys are the members' names. A seed beyond 2^53 becomes a string.
void append_json(std::string& out, const Manifest& manifest);

}  // namespace lorentz::report
