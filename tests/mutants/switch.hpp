// Included by a file with mutants, of a copy of the sources that `run` makes. A process runs the mutant that
// LORENTZ_MUTANT names, or none, and notes in the file LORENTZ_REACHED, a byte for each mutant, which ones it
// came by: the file is mapped, so that a process that is killed has noted them too.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

namespace lorentz_mutants {

inline constexpr int kMost = 1 << 16;
inline int active = 0;  // 0: none
inline unsigned char nowhere[kMost];
inline unsigned char* reached = nowhere;

inline bool set_up() {
  if (const char* number = std::getenv("LORENTZ_MUTANT")) active = std::atoi(number);
  if (const char* path = std::getenv("LORENTZ_REACHED")) {
    const int file = open(path, O_RDWR);
    struct stat its;
    if (file < 0 || fstat(file, &its) != 0 || its.st_size < kMost) std::abort();
    void* const bytes = mmap(nullptr, kMost, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (bytes == MAP_FAILED) std::abort();
    reached = static_cast<unsigned char*>(bytes);
    close(file);
  }
  return true;
}
inline const bool ready = set_up();

}  // namespace lorentz_mutants

// A constant expression is never a mutant's.
#define LORENTZ_MUTANT(n) (!__builtin_is_constant_evaluated() && lorentz_mutants::active == (n))
#define LORENTZ_REACHED(n) \
  (__builtin_is_constant_evaluated() ? void() : void(lorentz_mutants::reached[n] = 1))
