// What kernels need of CUDA, without a vendor's headers: compiled by clang for a graphics card (-x cuda
// --cuda-device-only -nocudainc -nocudalib), and by any compiler for the processor, where a kernel is a
// function and its threads are turns of a loop (LORENTZ_EMULATED_DEVICE). Private to the engine on graphics
// cards.
#pragma once

#include <cstdint>

namespace lorentz::device {

/// The threads of a block.
inline constexpr unsigned kThreads = 128;

}  // namespace lorentz::device

#if defined(LORENTZ_EMULATED_DEVICE)

#define LORENTZ_KERNEL(...) extern "C" void __VA_ARGS__
namespace lorentz::device {

/// Which thread runs, and of how many.
struct Place {
  std::uint64_t thread = 0, threads = 1;
};
inline thread_local Place place;

inline std::uint64_t thread() {
  return place.thread;
}
inline std::uint64_t threads() {
  return place.threads;
}
inline std::uint64_t add(std::uint64_t* to, std::uint64_t n) {
  return __atomic_fetch_add(to, n, __ATOMIC_RELAXED);
}
inline void add_of_warp(std::uint64_t* to, std::uint64_t n) {
  add(to, n);
}
inline void raise(std::uint64_t* to, std::uint64_t n) {
  *to = *to < n ? n : *to;
}

/// Counts of a block's threads, added to those of all in the end.
template <unsigned kSize>
class Counts {
 public:
  explicit Counts(std::uint64_t* all) : all_(all) {}
  void count(unsigned i) { add(&all_[i], 1); }
  void finish() {}

 private:
  std::uint64_t* all_;
};

}  // namespace lorentz::device

#elif defined(__CUDA__)

// Names that clang's own wrappers of <algorithm> and <new> expect, and headers that they would take from a
// vendor's.
#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#include <stdlib.h>
#include <new>
#pragma clang force_cuda_host_device begin
#define _GLIBCXX_INCLUDE_NEXT_C_HEADERS
#include <math.h>
#include <string.h>
#undef _GLIBCXX_INCLUDE_NEXT_C_HEADERS
#pragma clang force_cuda_host_device end

// At most 168 registers a thread: three blocks fit a multiprocessor.
#define LORENTZ_KERNEL(...)          \
  extern "C" __attribute__((global)) \
  __attribute__((launch_bounds(lorentz::device::kThreads, 3))) void __VA_ARGS__
namespace lorentz::device {

#define LORENTZ_ON_CARD __attribute__((device)) inline __attribute__((always_inline))
LORENTZ_ON_CARD unsigned thread_of_block() {
  return static_cast<unsigned>(__nvvm_read_ptx_sreg_tid_x());
}
LORENTZ_ON_CARD std::uint64_t thread() {
  return std::uint64_t{static_cast<unsigned>(__nvvm_read_ptx_sreg_ctaid_x())} * kThreads + thread_of_block();
}
LORENTZ_ON_CARD std::uint64_t threads() {
  return std::uint64_t{static_cast<unsigned>(__nvvm_read_ptx_sreg_nctaid_x())} * kThreads;
}
LORENTZ_ON_CARD std::uint64_t add(std::uint64_t* to, std::uint64_t n) {
  return __atomic_fetch_add(to, n, __ATOMIC_RELAXED);
}
LORENTZ_ON_CARD void raise(std::uint64_t* to, std::uint64_t n) {
  std::uint64_t before = __atomic_load_n(to, __ATOMIC_RELAXED);
  while (before < n &&
         !__atomic_compare_exchange_n(to, &before, n, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
  }
}
/// One addition for the 32 threads of a warp, all of which call it.
LORENTZ_ON_CARD void add_of_warp(std::uint64_t* to, std::uint64_t n) {
  for (int step = 16; step > 0; step /= 2) {
    const int low = __nvvm_shfl_sync_down_i32(-1, static_cast<int>(n), step, 31);
    const int high = __nvvm_shfl_sync_down_i32(-1, static_cast<int>(n >> 32), step, 31);
    n += static_cast<std::uint32_t>(low) | std::uint64_t{static_cast<std::uint32_t>(high)} << 32;
  }
  if (thread_of_block() % 32 == 0) add(to, n);
}

/// Counts of a block's threads, below 2^32, added to those of all in the end.
template <unsigned kSize>
class Counts {
 public:
  LORENTZ_ON_CARD explicit Counts(std::uint64_t* all) : all_(all) {
    for (unsigned i = thread_of_block(); i < kSize; i += kThreads) counts()[i] = 0;
    meet();
  }
  LORENTZ_ON_CARD void count(unsigned i) { __atomic_fetch_add(&counts()[i], 1u, __ATOMIC_RELAXED); }
  LORENTZ_ON_CARD void finish() {
    meet();
    for (unsigned i = thread_of_block(); i < kSize; i += kThreads)
      if (counts()[i] != 0) add(&all_[i], counts()[i]);
  }

 private:
  static LORENTZ_ON_CARD void meet() { __syncthreads(); }
  static LORENTZ_ON_CARD unsigned* counts() {
    static __attribute__((shared)) unsigned of_block[kSize];
    return of_block;
  }
  std::uint64_t* all_;
};
#undef LORENTZ_ON_CARD

}  // namespace lorentz::device

#endif

#define LORENTZ_EACH inline __attribute__((always_inline))

// The standard's functions that are not constexpr, before everything is for host and card.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>
