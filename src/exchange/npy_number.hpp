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
  const bool swap = must_swap(field), is_signed = field.kind == 'i';
  switch (field.bytes) {
    case 1:
      return is_signed ? number_in<std::int8_t, std::uint8_t>(bytes, false)
                       : std::int64_t{number_in<std::uint8_t, std::uint8_t>(bytes, false)};
    case 2:
      return is_signed ? number_in<std::int16_t, std::uint16_t>(bytes, swap)
                       : std::int64_t{number_in<std::uint16_t, std::uint16_t>(bytes, swap)};
    case 4:
      return is_signed ? number_in<std::int32_t, std::uint32_t>(bytes, swap)
                       : std::int64_t{number_in<std::uint32_t, std::uint32_t>(bytes, swap)};
    default:
      break;
  }
  const auto value = number_in<std::int64_t, std::uint64_t>(bytes, swap);
  return is_signed || value >= 0 ? std::optional(value) : std::nullopt;
}

}  // namespace lorentz
