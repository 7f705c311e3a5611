// The checksum of stored texts.
#pragma once

#include <cstdint>
#include <string_view>

namespace lorentz::runs {

inline constexpr std::uint64_t kCheckOfNothing = 0xcbf29ce484222325;

/// FNV-1a in 64 bits, of a text that follows one whose check is `before`. A change of a single byte is always
/// detected, because each step is one-to-one.
constexpr std::uint64_t check_of(std::string_view text, std::uint64_t before = kCheckOfNothing) {
  for (const char c : text) before = (before ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return before;
}

}  // namespace lorentz::runs
