// A graphics card by way of its driver, which is found at run time: libcuda.so.1. Nothing of it is needed to
// build.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lorentz::gpu {

struct Functions;  // of the driver

/// One card. Used by the thread that made it.
class Card {
 public:
  /// Card `number`, modulo how many there are. Throws InputError, with a sentence, if there is no driver, or
  /// no card.
  explicit Card(unsigned number);

  const std::string& name() const { return name_; }
  unsigned multiprocessors() const { return multiprocessors_; }

 private:
  friend class Memory;
  friend class Kernel;

  const Functions* driver_;
  std::string name_;
  unsigned multiprocessors_ = 0;
};

/// Bytes in a card's memory. All functions here and below throw std::runtime_error if the driver reports an
/// error.
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

 private:
  const Card& card_;
  std::uint64_t address_ = 0;
};

/// A function that runs on the card, in as many threads as it has room for.
class Kernel {
 public:
  /// `text`: PTX, which the driver compiles.
  Kernel(const Card& card, const char* text, const std::string& name);
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
