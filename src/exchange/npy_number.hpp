// Numbers as they stand in a .npy file. Private to the formats.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>

#include "src/exchange/npy_header.hpp"

namespace lorentz {

template <class Bits>
Bits swapped(Bits bits) {
  Bits other = 0;
  for (std::size_t i = 0; i < sizeof bits; ++i)
    other = static_cast<Bits>(other << 8 | (bits >> 8 * i & 0xff));
  return other;
}

// The number at `bytes`; Bits has its size.
template <class Number, class Bits>
Number number_in(const char* bytes, bool swap) {
  Bits bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return std::bit_cast<Number>(swap ? swapped(bits) : bits);
}

inline bool must_swap(const NpyField& field) {
  return field.big_endian != (std::endian::native == std::endian::big);
}

// An integer of any integer type of NumPy; nothing beyond the range of int64.
inline std::optional<std::int64_t> integer_at(const NpyField& field, const char* bytes) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < field.bytes; ++i) {
    const char byte = bytes[field.big_endian ? field.bytes - 1 - i : i];
    bits |= std::uint64_t{static_cast<unsigned char>(byte)} << 8 * i;
  }
  const std::size_t unused = 64 - 8 * field.bytes;
  if (field.kind == 'i') return static_cast<std::int64_t>(bits << unused) >> unused;
  return bits >> 63 ? std::nullopt : std::optional(static_cast<std::int64_t>(bits));
}

}  // namespace lorentz
