// Counts what is allocated, by replacing the global operator new: for one file of a program, which includes
// this unless the address sanitizer is there, with an operator new of its own.
#pragma once

#include <cstdlib>
#include <new>

namespace lorentz::test {
inline long allocations = 0;
}

void* operator new(std::size_t size) {
  ++lorentz::test::allocations;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
