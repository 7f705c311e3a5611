// A graphics card by way of its driver, which is found at run time: libcuda.so.1. Nothing of it is needed to
// build.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "src/engines/gpu/kernel_texts.hpp"

namespace lorentz::gpu {

struct Functions;  // of the driver

/// One card. All functions from here on, but its constructor, throw std::runtime_error if the driver reports
/// an error.
class Card {
 public:
  /// Card `number`, modulo how many there are. Throws InputError, with a sentence, if there is no driver, or
  /// no card.
  explicit Card(unsigned number);

  const std::string& name() const { return name_; }
  unsigned multiprocessors() const { return multiprocessors_; }

  /// Lets this thread use it, and what is made for it. The thread that made it need not call this.
  void enter() const;

  /// Memory here that kernels can read and write, until the program ends.
  void* pinned(std::size_t size) const;

  /// Copies from the card's memory, and to it.
  void get(void* to, const void* from, std::size_t size) const;
  void put(void* to, const void* from, std::size_t size) const;

 private:
  friend class Memory;
  friend class Kernel;

  const Functions* driver_;
  void* context_ = nullptr;
  std::string name_;
  unsigned multiprocessors_ = 0;
};

/// Bytes in a card's memory.
class Memory {
 public:
  Memory(const Card& card, std::size_t size);
  ~Memory();
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  void clear(std::size_t size);
  void put(const void* from, std::size_t size);
  void take(void* to, std::size_t size, std::size_t begin = 0) const;
  std::uint64_t address() const { return address_; }
  template <class T>
  T* at() const {
    return reinterpret_cast<T*>(address_);
  }

 private:
  const Card& card_;
  std::uint64_t address_ = 0;
};

/// A function that runs on the card, in as many threads as it has room for.
class Kernel {
 public:
  /// The text of this kind is PTX, which the driver compiles. Throws InputError if there is none.
  Kernel(const Card& card, const KernelTexts& texts, const std::string& kind, const std::string& name);
  ~Kernel();
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;

  /// Starts it with these addresses as arguments, and returns at once.
  void start(const std::vector<std::uint64_t>& arguments) const;
  /// Waits until it has ended.
  void wait() const;

 private:
  const Card& card_;
  void *module_ = nullptr, *function_ = nullptr;
  unsigned blocks_ = 0;
};

}  // namespace lorentz::gpu
