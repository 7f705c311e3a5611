// What an engine claims, and by which it is judged: the precision of its numbers, and of its times.
#pragma once

#include <optional>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz {

/// A format of IEEE 754 for an engine's numbers.
enum class NumberFormat { binary64, binary32 };

constexpr int bits_of(NumberFormat precision) {  ///< of the significand
  return precision == NumberFormat::binary64 ? 53 : 24;
}

inline const char* name_of(NumberFormat precision) {
  return precision == NumberFormat::binary64 ? "binary64" : "binary32";
}

/// By which an engine is judged (docs/verdicts.md).
struct Claim {
  NumberFormat precision = NumberFormat::binary64;
  /// T: a time is right if it is off by at most T times itself. Infinite: times are not judged.
  std::optional<double> time_tolerance = {};

  friend bool operator==(const Claim&, const Claim&) = default;
};

/// The nearest number of that precision; infinite beyond its range.
double rounded(double value, NumberFormat precision);

/// Distance to the next number of that precision away from zero; of what is beyond its range that of the largest
/// finite one.
double ulp(double value, NumberFormat precision);

/// Do scenes and queries consist of numbers of that precision?
bool consists_of(const Scene& scene, NumberFormat precision);
bool consists_of(const Query& query, NumberFormat precision);

/// All numbers rounded.
Scene rounded(Scene scene, NumberFormat precision);
Query rounded(Query query, NumberFormat precision);

}  // namespace lorentz
