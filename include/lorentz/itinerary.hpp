// Certified itineraries: which obstacles a particle hits one after another, and where it is, with proof.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/pimpl.hpp>
#include <lorentz/rational.hpp>

namespace lorentz::oracle {

/// The most bits that numbers may have.
inline constexpr long kMostBits = 1L << 26;

/// How far to follow the particle, and what to report besides the itinerary.
struct Journey {
  std::optional<std::uint64_t> collisions;  ///< at most this many collisions
  std::optional<Rational> time;             ///< and none after this time
  int digits = 17;                          ///< of times, positions and velocities; at most kMostDigits
  bool states = false;                      ///< also report position and velocity at each collision
  long first_bits = 0;                      ///< initial precision (0: from `digits`); it grows as needed,
  long most_bits = 0;                       ///< up to this precision (0: 2^18, or what `digits` need)
  const std::atomic<bool>* stop = nullptr;  ///< once true, the journey ends as `undecided`, wherever it is
};

/// A collision with everything about it certain. Decimals are correctly rounded.
struct CertifiedCollision {
  ObstacleId obstacle;
  std::string time;            ///< since the start
  std::vector<std::string> x;  ///< the position of the collision, if `states` is set
  std::vector<std::string> v;  ///< the velocity after it, if `states` is set
  double nearest_time = 0;     ///< the time in binary64, to within a few ulps
  Vec offset{}, velocity{};    ///< from the obstacle's centre, and after the collision; to within a few ulps
  long bits = 0;               ///< bits lost: an error of the start has grown by a factor of about 2^bits
};

enum class JourneyEnd { collisions, time, never, inside, undecided };
std::string_view name_of(JourneyEnd end);

/// How a journey ended, and where. At a collision: the position of the collision and the velocity after it.
struct Arrival {
  JourneyEnd end = JourneyEnd::undecided;
  std::uint64_t collisions = 0;
  long bits = 0;  ///< the working precision that made everything certain
  std::vector<std::string> x, v;
  std::string distance;  ///< from the origin
};

/// Itineraries in one scene, computed in ball arithmetic of growing precision and with exact searches.
///
///  1. Every reported obstacle is the true one and every decimal digit is correctly rounded, whatever the
///     numbers of scene and start. (A number within 2^-96 of itself from the midpoint between two decimals
///     has one or two digits more.)
///  2. More precision, reversed time, or another basis, frame or unit gives the same itinerary.
///  3. A journey that no precision decides ends as `undecided`, at `most_bits`.
///  4. Any number of threads may follow journeys of one Itinerary.
///
/// Cost: a passage of N collisions at B bits takes N times a few dozen operations of B bits, and B is
/// proportional to N. docs/itineraries.md has times. Memory: the itinerary.
///
/// Source: this project; the error box is R. Lohner's.
class Itinerary {
 public:
  /// Throws InputError if the scene is invalid (a radius not above 0, dependent vectors).
  explicit Itinerary(const RationalScene& scene);
  Itinerary(Itinerary&&) noexcept;
  Itinerary& operator=(Itinerary&&) noexcept;
  ~Itinerary();

  using OnCollision = std::function<bool(const CertifiedCollision&)>;

  /// Calls `on_collision` for each collision, in order, as soon as all its digits are certain. If the
  /// callback returns false, the journey ends there (as `collisions`). Throws InputError if v = 0, if
  /// digits or bits are out of range, if the time is not finite and above 0, or if nothing ends the journey.
  Arrival follow(const Start& start, const Journey& journey, const OnCollision& on_collision = {}) const;

 private:
  struct Impl;
  Pimpl<const Impl> impl_;
};

/// The nearest binary64 of every number: the problem as binary64 programs see it. Numbers beyond binary64's
/// range become infinite, which makes the result invalid (flaw_of). `degrees` become a velocity. Throws
/// std::domain_error if a denominator is 0.
double nearest(const Rational& number);
Scene nearest(const RationalScene& scene);
Query nearest(const Start& start);

/// Name and version of the interval library.
std::string itinerary_libraries();

}  // namespace lorentz::oracle
