// What all harnesses have in common. A harness turns any bytes into work for a part of the project and holds
// the outcome against a promise; a broken promise ends the program, so that whoever feeds it bytes notices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

/// The entry point that libFuzzer calls (and replay_main.cpp): one input.
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
