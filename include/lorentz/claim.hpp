// What an engine claims: the precision of its numbers and times, the questions that it is made for, and what it does with
// starts inside. It is judged by this.
#pragma once

#include <limits>
#include <optional>
#include <string_view>

#include <lorentz/answer.hpp>
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

/// The questions that an engine is made for. Intervals are closed, in the units of the scene.
struct Domain {
  struct Range {
    double low = 0, high = std::numeric_limits<double>::infinity();

    bool contains(double size) const { return low <= size && size <= high; }
    friend bool operator==(const Range&, const Range&) = default;
  };
  Range speed = {};        ///< |v|
  Range coordinates = {};  ///< the largest component of x, and of the positions of atoms
  Range radius = {};       ///< of balls, and the lengths of the semiaxes of ellipsoids
  Range flight = {};       ///< |v| t of a hit
  bool dimension_2 = true, dimension_3 = true, balls = true, ellipsoids = true;
  bool limits = true;  ///< it is given limits (max_time)

  bool has(const Scene& scene) const;
  bool has(const Query& query) const;
  /// For a valid query and its exact answer: false for a hit beyond `flight`.
  bool has(const Query& query, const Answer& exact) const;
  /// The query, if it is inside; or the same flight at 2^k times the speed, if that is inside and exact.
  std::optional<Query> bring_inside(const Query& query) const;

  friend bool operator==(const Domain&, const Domain&) = default;
};

/// The ranges of a domain, by the names that claims and --domain have for them.
struct NamedRange {
  const char* name;
  Domain::Range Domain::*range;
};
inline constexpr NamedRange kDomainRanges[] = {{"speed", &Domain::speed},
                                               {"coordinates", &Domain::coordinates},
                                               {"radius", &Domain::radius},
                                               {"flight", &Domain::flight}};

/// What an engine answers if x lies in open obstacles (`from` excepted).
enum class StartInside {
  inside,  ///< Outcome::inside, with the smallest of them (lattice, atom, cell)
  miss,    ///< what it would answer if they were not there
  zero,    ///< a hit of the smallest of them, at time 0
  exit,  ///< a hit of the one that the line leaves first, when it leaves it; of several at once, the smallest
  unsupported  ///< it is not asked
};

/// The claims by which an engine is judged (docs/verdicts.md).
struct Claim {
  NumberFormat precision = NumberFormat::binary64;
  /// T: a time is right if its error is at most T times the time itself. If T is infinite, times are not
  /// judged.
  std::optional<double> time_tolerance = {};
  StartInside inside = StartInside::inside;
  Domain domain = {};

  friend bool operator==(const Claim&, const Claim&) = default;
};

/// The rule's name, "inside", "miss", .., and the rule with this name, if any.
std::string_view name_of(StartInside rule);
std::optional<StartInside> start_inside_named(std::string_view name);

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
