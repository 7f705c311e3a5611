// What an engine claims about the precision of its numbers and times. It is judged by this.
#pragma once

#include <optional>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz {

/// An IEEE 754 format for an engine's numbers.
enum class NumberFormat { binary64, binary32 };

constexpr int bits_of(NumberFormat precision) {  ///< bits of the significand
  return precision == NumberFormat::binary64 ? 53 : 24;
}

inline const char* name_of(NumberFormat precision) {
  return precision == NumberFormat::binary64 ? "binary64" : "binary32";
}

/// The claims by which an engine is judged (docs/verdicts.md).
struct Claim {
  NumberFormat precision = NumberFormat::binary64;
  /// T: a time is right if its error is at most T times the time itself. If T is infinite, times are not
  /// judged.
  std::optional<double> time_tolerance = {};

  friend bool operator==(const Claim&, const Claim&) = default;
};

/// The nearest number of this precision; infinite if `value` is beyond its range.
double rounded(double value, NumberFormat precision);

/// The distance to the next number of this precision away from zero. Beyond the range, that of the largest
/// finite number.
double ulp(double value, NumberFormat precision);

/// True if all numbers of the scene or query are of this precision.
bool consists_of(const Scene& scene, NumberFormat precision);
bool consists_of(const Query& query, NumberFormat precision);

/// The scene or query with all numbers rounded.
Scene rounded(Scene scene, NumberFormat precision);
Query rounded(Query query, NumberFormat precision);

}  // namespace lorentz
