#include "src/engines/gpu/driver.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <stdexcept>

#include <lorentz/errors.hpp>
#include "src/engines/gpu/device.hpp"

namespace lorentz::gpu {

// The functions of the driver's interface, with its names and types.
struct Functions {
  using Handle = void*;
  template <class... Parameters>
  using Function = int (*)(Parameters...);

  Function<unsigned> cuInit;
  Function<int*> cuDeviceGetCount;
  Function<int*, int> cuDeviceGet;
  Function<char*, int, int> cuDeviceGetName;
  Function<int*, int, int> cuDeviceGetAttribute;
  Function<Handle*, int> cuDevicePrimaryCtxRetain;
  Function<Handle> cuCtxSetCurrent;
  Function<> cuCtxSynchronize;
  Function<Handle*, const void*> cuModuleLoadData;
  Function<Handle> cuModuleUnload;
  Function<Handle*, Handle, const char*> cuModuleGetFunction;
  Function<int*, Handle, int, std::size_t> cuOccupancyMaxActiveBlocksPerMultiprocessor;
  Function<std::uint64_t*, std::size_t> cuMemAlloc_v2;
  Function<std::uint64_t> cuMemFree_v2;
  Function<void**, std::size_t, unsigned> cuMemHostAlloc;
  Function<std::uint64_t, const void*, std::size_t> cuMemcpyHtoD_v2;
  Function<void*, std::uint64_t, std::size_t> cuMemcpyDtoH_v2;
  Function<std::uint64_t, unsigned char, std::size_t> cuMemsetD8_v2;
  Function<Handle, unsigned, unsigned, unsigned, unsigned, unsigned, unsigned, unsigned, Handle, void**,
           void**>
      cuLaunchKernel;
  Function<int, const char**> cuGetErrorName;

  // Throws InputError.
  static const Functions& found() {
    static const Functions all = loaded();
    return all;
  }

  void check(int error, const char* what) const {
    if (error == 0) return;
    const char* name = nullptr;
    cuGetErrorName(error, &name);
    throw std::runtime_error(std::string("the graphics card's driver: ") + what + ": " +
                             (name ? name : "error " + std::to_string(error)));
  }

 private:
  static Functions loaded() {
    void* const library = dlopen("libcuda.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library)
      throw InputError(
          "there is no libcuda.so.1 here: no driver of an NVIDIA graphics card is installed; certified-batch "
          "gives the same results without one");
    Functions all;
    const auto find = [library](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
      if (!function)
        throw InputError(std::string("the graphics card's driver is too old: it has no ") + name);
    };
#define LORENTZ_FIND(name) find(all.name, #name)
    LORENTZ_FIND(cuInit), LORENTZ_FIND(cuDeviceGetCount), LORENTZ_FIND(cuDeviceGet);
    LORENTZ_FIND(cuDeviceGetName), LORENTZ_FIND(cuDeviceGetAttribute), LORENTZ_FIND(cuDevicePrimaryCtxRetain);
    LORENTZ_FIND(cuCtxSetCurrent), LORENTZ_FIND(cuCtxSynchronize), LORENTZ_FIND(cuModuleLoadData);
    LORENTZ_FIND(cuModuleUnload), LORENTZ_FIND(cuModuleGetFunction);
    LORENTZ_FIND(cuOccupancyMaxActiveBlocksPerMultiprocessor), LORENTZ_FIND(cuMemAlloc_v2);
    LORENTZ_FIND(cuMemFree_v2), LORENTZ_FIND(cuMemcpyHtoD_v2), LORENTZ_FIND(cuMemcpyDtoH_v2);
    LORENTZ_FIND(cuMemsetD8_v2), LORENTZ_FIND(cuMemHostAlloc), LORENTZ_FIND(cuLaunchKernel);
    LORENTZ_FIND(cuGetErrorName);
#undef LORENTZ_FIND
    return all;
  }
};

// Calls a function of the driver, and throws if it reports an error.
#define LORENTZ_CALL(driver, name, ...) (driver).check((driver).name(__VA_ARGS__), #name)

Card::Card(unsigned number) : driver_(&Functions::found()) {
  int count = 0;
  if (driver_->cuInit(0) != 0 || driver_->cuDeviceGetCount(&count) != 0 || count == 0)
    throw InputError(
        "the driver finds no graphics card here; certified-batch gives the same results without one");
  int device = 0, multiprocessors = 0;
  char name[128] = {};
  constexpr int kMultiprocessors = 16;  // CU_DEVICE_ATTRIBUTE_MULTIPROCESSOR_COUNT
  LORENTZ_CALL(*driver_, cuDeviceGet, &device, static_cast<int>(number % static_cast<unsigned>(count)));
  LORENTZ_CALL(*driver_, cuDeviceGetName, name, sizeof name - 1, device);
  LORENTZ_CALL(*driver_, cuDeviceGetAttribute, &multiprocessors, kMultiprocessors, device);
  LORENTZ_CALL(*driver_, cuDevicePrimaryCtxRetain, &context_, device);
  enter();
  name_ = name, multiprocessors_ = static_cast<unsigned>(multiprocessors);
}

void Card::enter() const {
  LORENTZ_CALL(*driver_, cuCtxSetCurrent, context_);
}

void* Card::pinned(std::size_t size) const {
  void* memory = nullptr;
  LORENTZ_CALL(*driver_, cuMemHostAlloc, &memory, size, 0);
  return memory;
}

void Card::get(void* to, const void* from, std::size_t size) const {
  LORENTZ_CALL(*driver_, cuMemcpyDtoH_v2, to, reinterpret_cast<std::uint64_t>(from), size);
}

void Card::put(void* to, const void* from, std::size_t size) const {
  LORENTZ_CALL(*driver_, cuMemcpyHtoD_v2, reinterpret_cast<std::uint64_t>(to), from, size);
}

Memory::Memory(const Card& card, std::size_t size) : card_(card) {
  LORENTZ_CALL(*card_.driver_, cuMemAlloc_v2, &address_, size);
}

Memory::~Memory() {
  if (card_.driver_->cuCtxSetCurrent(card_.context_) == 0) card_.driver_->cuMemFree_v2(address_);
}

void Memory::clear(std::size_t size) {
  LORENTZ_CALL(*card_.driver_, cuMemsetD8_v2, address_, 0, size);
}

void Memory::put(const void* from, std::size_t size) {
  card_.put(at<void>(), from, size);
}

void Memory::take(void* to, std::size_t size, std::size_t begin) const {
  card_.get(to, at<char>() + begin, size);
}

Kernel::Kernel(const Card& card, const KernelTexts& texts, const std::string& kind, const std::string& name)
    : card_(card) {
  const auto text = texts.find(kind);
  if (text == texts.end())
    throw InputError(
        "this build has no kernels for graphics cards: clang was not found when it was configured "
        "(docs/gpu.md)");
  const Functions& driver = *card_.driver_;
  int blocks = 0;
  LORENTZ_CALL(driver, cuModuleLoadData, &module_, text->second);
  LORENTZ_CALL(driver, cuModuleGetFunction, &function_, module_, name.c_str());
  LORENTZ_CALL(driver, cuOccupancyMaxActiveBlocksPerMultiprocessor, &blocks, function_, device::kThreads, 0);
  blocks_ = static_cast<unsigned>(std::max(blocks, 1)) * card_.multiprocessors();
}

Kernel::~Kernel() {
  card_.driver_->cuModuleUnload(module_);
}

void Kernel::start(const std::vector<std::uint64_t>& arguments) const {
  std::vector<void*> places;
  for (const std::uint64_t& argument : arguments) places.push_back(const_cast<std::uint64_t*>(&argument));
  LORENTZ_CALL(*card_.driver_, cuLaunchKernel, function_, blocks_, 1, 1, device::kThreads, 1, 1, 0, nullptr,
               places.data(), nullptr);
}

void Kernel::wait() const {
  LORENTZ_CALL(*card_.driver_, cuCtxSynchronize);
}

}  // namespace lorentz::gpu
