// Runs a harness on the given files and folders, without libFuzzer. So every build has the harnesses, and
// what they once found stays found. With --edits N it also runs N small changes of each file.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "tests/harness/harness.hpp"

// The harness's own way to change an input, if it has one.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) __attribute__((weak));

namespace {
std::minstd_rand random_bits;
}

/// In place of libFuzzer's function for a harness's own mutator: changes a byte or two at random.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t) {
  for (auto count = 1 + random_bits() % 2; size > 0 && count > 0; --count)
    data[random_bits() % size] = static_cast<std::uint8_t>(random_bits() % 256);
  return size;
}

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

std::vector<fs::path> files_of(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

Bytes content_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    std::fprintf(stderr, "%s: cannot be read\n", path.c_str());
    std::exit(3);
  }
  return {std::istreambuf_iterator<char>(in), {}};
}

// The input is in memory of its own size, so that a read beyond it is noticed.
void run(const Bytes& input) {
  const Bytes lone(input.begin(), input.end());
  LLVMFuzzerTestOneInput(lone.data(), lone.size());
}

// The n-th change of an input, which depends on these two alone.
Bytes edited(Bytes input, unsigned n) {
  const std::size_t size = input.size(), most = size + 256;
  input.resize(most);
  random_bits.seed(n);
  input.resize(LLVMFuzzerCustomMutator ? LLVMFuzzerCustomMutator(input.data(), size, most, n)
                                       : LLVMFuzzerMutate(input.data(), size, most));
  return input;
}

}  // namespace

int main(int count, char** arguments) {
  unsigned edits = 0;
  std::size_t inputs = 0;
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(arguments[i], "--edits") == 0 && i + 1 < count) {
      edits = static_cast<unsigned>(std::atoi(arguments[++i]));
      continue;
    }
    for (const fs::path& file : files_of(arguments[i])) {
      const Bytes input = content_of(file);
      for (unsigned n = 0; n <= edits; ++n) {
        std::fprintf(stderr, n == 0 ? "%s\n" : "%s, change %u\n", file.c_str(), n);
        run(n == 0 ? input : edited(input, n));
        ++inputs;
      }
    }
  }
  std::printf("%zu inputs, no promise broken\n", inputs);
  if (inputs == 0) std::fprintf(stderr, "usage: harness_NAME [--edits N] FILE|FOLDER ...\n");
  return inputs == 0 ? 2 : 0;
}
