// The identity of an obstacle: lattice, atom and cell.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace lorentz {

/// A 128-bit integer, for values that must not overflow where 64 bits do.
__extension__ using WideInteger = __int128;

/// An integer of any size. Cell coordinates nearly always fit into 64 bits; exact answers sometimes do not.
class Integer {
 public:
  Integer(std::int64_t value = 0) : value_(value) {}
  Integer(const Integer& other) : value_(other.value_) {
    if (other.digits_) digits_ = std::make_unique<const std::string>(*other.digits_);
  }
  Integer(Integer&&) noexcept = default;
  Integer& operator=(const Integer& other) { return *this = Integer(other); }
  Integer& operator=(Integer&&) noexcept = default;
  Integer& operator=(std::int64_t value) {
    value_ = value;
    digits_.reset();
    return *this;
  }
  ~Integer() = default;

  static Integer of(WideInteger value) {
    const auto low = static_cast<std::int64_t>(value);
    return low == value ? Integer(low) : of_wide(value);
  }

  /// Reads an optional '-' and decimal digits; any other text yields nothing. Leading zeros are dropped.
  static std::optional<Integer> from_decimal(std::string_view text);

  bool fits_int64() const { return !digits_; }
  std::int64_t int64() const { return value_; }  ///< requires fits_int64()
  std::optional<WideInteger> int128() const {    ///< nothing beyond 10^38
    return fits_int64() ? std::optional<WideInteger>(value_) : int128_of_digits();
  }
  std::string decimal() const;

  friend bool operator==(const Integer& a, const Integer& b) {
    if (a.fits_int64() || b.fits_int64()) return a.digits_ == b.digits_ && a.value_ == b.value_;
    return *a.digits_ == *b.digits_;
  }

 private:
  std::int64_t value_ = 0;
  std::unique_ptr<const std::string>
      digits_;  ///< canonical decimal form if 64 bits cannot hold it, else null

  std::optional<WideInteger> int128_of_digits() const;
  static Integer of_wide(WideInteger value);
};

/// Coordinates n of a lattice cell. A 2D problem keeps the third at zero.
using Cell = std::array<Integer, 3>;

/// The obstacle of atom `atom` of lattice `lattice`, translated into the cell `cell`.
struct ObstacleId {
  int lattice = 0;
  int atom = 0;
  Cell cell{};

  friend bool operator==(const ObstacleId&, const ObstacleId&) = default;
};

}  // namespace lorentz
