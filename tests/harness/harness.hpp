// The parts that all harnesses share. A harness turns any bytes into work for a part of the project and
// checks a promise about the outcome. A broken promise ends the program, so that the fuzzer notices it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

/// The entry point that libFuzzer (or replay_main.cpp) calls with one input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace lorentz::harness {

/// Says which promise was broken, and by what, and ends the program.
[[noreturn]] inline void fail(const std::string& promise, const std::string& about) {
  std::fprintf(stderr, "broken: %s\n%s\n", promise.c_str(), about.c_str());
  std::abort();
}

inline void require(bool holds, const char* promise, const std::string& about) {
  if (!holds) fail(promise, about);
}

}  // namespace lorentz::harness
