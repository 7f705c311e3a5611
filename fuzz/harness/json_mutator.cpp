// How the harnesses of JSON texts change their inputs: half of the time by whole numbers, members and lines.
#include <algorithm>
#include <cstdint>
#include <cstring>

#include "fuzz/harness/input_file.hpp"
#include "fuzz/harness/json_edit.hpp"

/// libFuzzer's own, or replay_main.cpp's.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  using namespace lorentz::harness;
  std::minstd_rand random(seed);
  if (random() % 2 == 0) return LLVMFuzzerMutate(data, size, most);
  std::string text(text_of(data, size));
  for (auto edits = 1 + random() % 3; edits > 0; --edits) text = edited(text, random);
  const std::size_t count = std::min(text.size(), most);
  std::memcpy(data, text.data(), count);
  return count;
}
