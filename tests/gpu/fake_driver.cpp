// A libcuda.so.1 without a card: the functions of the driver's interface that the program calls, and the
// kernels compiled for the processor. What comes before and after a kernel is tested with it, and the
// kernels' sources are. FAKE_CARD: "none" has no card; "wrong" one whose results have a bit that is another;
// "broken" one that fails from the first kernel on. It is as late as a card may be: a kernel runs when it is waited for, or when memory is copied. New memory is
// dirty.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#define LORENTZ_EMULATED_DEVICE
#include "src/engines/gpu/kernels.cpp"
#undef LORENTZ_KIND
#include "statistics/gpu/kernels.cpp"

namespace {

using lorentz::gpu::CardColumns, lorentz::gpu::DrawnFlights, lorentz::gpu::DrawnTally;

// A kernel of either family.
struct Kernel {
  void (*drawn)(const DrawnFlights*, DrawnTally*);
  void (*columns)(const CardColumns*);
};

const std::map<std::string, Kernel>& kernels() {
  static const std::map<std::string, Kernel> all{
#undef LORENTZ_KIND
#define LORENTZ_KIND(name, ...) {#name, {name, nullptr}}, {"columns_" #name, {nullptr, columns_##name}},
#include "src/engines/gpu/kinds.inc"
  };
  return all;
}

bool is(const char* what) {
  const char* const how = std::getenv("FAKE_CARD");
  return how && std::strcmp(how, what) == 0;
}

template <class T>
T* at(std::uint64_t address) {
  return reinterpret_cast<T*>(address);
}

constexpr int kGood = 0, kBad = 1;

struct Launch {
  const Kernel* kernel;
  std::uint64_t threads, arguments[2];

  void run() const {
    auto& [thread, all] = lorentz::device::place;
    all = threads;
    for (thread = 0; thread < all; ++thread)
      if (kernel->drawn)
        kernel->drawn(at<DrawnFlights>(arguments[0]), at<DrawnTally>(arguments[1]));
      else
        kernel->columns(at<CardColumns>(arguments[0]));
    if (!is("wrong")) return;
    if (kernel->drawn)
      at<DrawnTally>(arguments[1])->time.digits[33] ^= 1;
    else
      at<CardColumns>(arguments[0])->cell[1][7] ^= 1;
  }
};

std::mutex mutex;
std::vector<Launch> waiting;
bool is_broken = false;

int finish() {
  const std::lock_guard lock(mutex);
  for (const Launch& one : waiting) one.run();
  waiting.clear();
  return kGood;
}

void* dirty(std::size_t size) {
  return std::memset(std::malloc(size), 0xa5, size);
}

}  // namespace

extern "C" {

int cuInit(unsigned) {
  return kGood;
}
int cuDeviceGetCount(int* count) {
  return *count = is("none") ? 0 : 2, kGood;
}
int cuDeviceGet(int* device, int number) {
  return *device = number, kGood;
}
int cuDeviceGetName(char* name, int size, int) {
  return std::strncpy(name, "a fake card", static_cast<std::size_t>(size)), kGood;
}
int cuDeviceGetAttribute(int* value, int, int) {
  return *value = 3, kGood;
}
int cuDevicePrimaryCtxRetain(void** context, int) {
  return *context = nullptr, kGood;
}
int cuCtxSetCurrent(void*) {
  return is_broken ? kBad : kGood;
}
int cuCtxSynchronize() {
  return finish();
}
int cuModuleLoadData(void** module, const void* text) {
  *module = nullptr;
  return std::strstr(static_cast<const char*>(text), ".target sm_70") ? kGood : kBad;
}
int cuModuleUnload(void*) {
  return kGood;
}
int cuModuleGetFunction(void** function, void*, const char* name) {
  const auto found = kernels().find(name);
  if (found == kernels().end()) return kBad;
  return *function = const_cast<Kernel*>(&found->second), kGood;
}
int cuOccupancyMaxActiveBlocksPerMultiprocessor(int* blocks, void*, int, std::size_t) {
  return *blocks = 2, kGood;
}
int cuMemAlloc_v2(std::uint64_t* address, std::size_t size) {
  return *address = reinterpret_cast<std::uint64_t>(dirty(size)), kGood;
}
int cuMemFree_v2(std::uint64_t address) {
  return finish(), std::free(at<void>(address)), kGood;
}
int cuMemHostAlloc(void** memory, std::size_t size, unsigned) {
  return *memory = dirty(size), kGood;
}
int cuMemcpyHtoD_v2(std::uint64_t to, const void* from, std::size_t size) {
  return finish(), std::memcpy(at<void>(to), from, size), kGood;
}
int cuMemcpyDtoH_v2(void* to, std::uint64_t from, std::size_t size) {
  return finish(), std::memcpy(to, at<void>(from), size), kGood;
}
int cuMemsetD8_v2(std::uint64_t address, unsigned char value, std::size_t size) {
  return finish(), std::memset(at<void>(address), value, size), kGood;
}
int cuLaunchKernel(void* function, unsigned blocks, unsigned, unsigned, unsigned threads, unsigned, unsigned,
                   unsigned, void*, void** arguments, void**) {
  const auto argument = [&](int i) { return *static_cast<std::uint64_t*>(arguments[i]); };
  const auto* const kernel = static_cast<Kernel*>(function);
  if (is("broken")) return is_broken = true, kBad;
  const std::lock_guard lock(mutex);
  waiting.push_back(
      {kernel, std::uint64_t{blocks} * threads, {argument(0), kernel->drawn ? argument(1) : 0}});
  return kGood;
}
int cuGetErrorName(int, const char** name) {
  return *name = "FAKE_ERROR", kGood;
}

}  // extern "C"
