// Certified itineraries: which obstacles a particle hits one after another, and where it is, proven.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/pimpl.hpp>
#include <lorentz/rational.hpp>

namespace lorentz::oracle {

/// How far to follow it, and what is wanted besides the itinerary.
struct Journey {
  std::optional<std::uint64_t> collisions;  ///< at most so many
  std::optional<Rational> time;             ///< and none after this time
  int digits = 17;                          ///< of times, places, velocities
  bool states = false;                      ///< place and velocity at each collision, too
  long first_bits = 0;                      ///< the precision to begin with (0: by the digits); it grows ..
  long most_bits = 0;                       ///< .. as it must, to this at most (0: 2^18, or what digits need)
  const std::atomic<bool>* stop = nullptr;  ///< once this is true it ends, `undecided`, however far it is
};

/// A collision of which everything is certain. Decimals are correctly rounded.
struct CertifiedCollision {
  ObstacleId obstacle;
  std::string time;            ///< since the start
  std::vector<std::string> x;  ///< the place of the collision, if states are wanted
  std::vector<std::string> v;  ///< the velocity after it, likewise
  double nearest_time = 0;     ///< in binary64, to within some ulps
  Vec offset{}, velocity{};    ///< from the obstacle's centre, and after the collision; likewise
  long bits = 0;               ///< that are lost: an error of the start has grown 2^bits times, about
};

enum class JourneyEnd { collisions, time, never, inside, undecided };
std::string_view name_of(JourneyEnd end);

/// How a journey ended, and where. At a collision: place of the collision, velocity after it.
struct Arrival {
  JourneyEnd end = JourneyEnd::undecided;
  std::uint64_t collisions = 0;
  long bits = 0;  ///< of working precision, that made all of it certain
  std::vector<std::string> x, v;
  std::string distance;  ///< from the origin
};

/// Itineraries in one scene, by balls of growing precision and exact searches.
///
///  1. Every obstacle that is told is the true one, every decimal digit correctly rounded, whatever the
///     numbers of scene and start are. (A number that is midway between two decimals to within 2^-96 of
///     itself has one or two digits less.)
///     held by "Itinerary: problem 2 of the 100-digit challenge, to the published digits",
///             "Itinerary: what is certain of an enclosure is what the oracle says",
///             "Itinerary: an exact state is decided exactly, whatever the family"
///  2. More precision, time reversed, another basis, frame or unit: the same itinerary.
///     held by "Itinerary: more bits than needed change nothing",
///             "Itinerary: reversed, a particle comes back to its start",
///             "Itinerary: in another basis, elsewhere, turned, and in another unit"
///  3. What no precision decides ends in `undecided`, at most_bits.
///     held by "Itinerary: how journeys end"
///  4. Any number of threads may follow journeys of one Itinerary.
///
/// Cost: a passage at B bits takes N times a few dozen operations of B bits, B proportional to N; 1000
/// collisions in 2D at r = 1e-3 some 0.4 s, in 3D 1.6 s (docs/itineraries.md). Memory: the itinerary.
///
/// Source: this project; the box of errors is R. Lohner's.
class Itinerary {
 public:
  /// Throws InputError if the scene has a flaw (radius not above 0, dependent vectors).
  explicit Itinerary(const RationalScene& scene);
  Itinerary(Itinerary&&) noexcept;
  Itinerary& operator=(Itinerary&&) noexcept;
  ~Itinerary();

  using OnCollision = std::function<bool(const CertifiedCollision&)>;

  /// Calls on_collision for each collision, in order, as soon as it is certain to all digits; false from it
  /// ends the journey there (as `collisions`). Throws InputError for a start with v = 0, no
  /// digits, a time that is not above 0, a journey that nothing ends.
  Arrival follow(const Start& start, const Journey& journey, const OnCollision& on_collision = {}) const;

 private:
  struct Impl;
  Pimpl<const Impl> impl_;
};

/// What plain arithmetic of so many bits makes of a trajectory: the same formulas, every result rounded to
/// nearest, the next obstacle decided exactly for the rounded state. Nothing about it is certain: it is what
/// certified itineraries are for, to be held against.
class RoundedItinerary {
 public:
  /// As Itinerary and its follow(). bits >= 2.
  RoundedItinerary(const RationalScene& scene, const Start& start, long bits);
  RoundedItinerary(RoundedItinerary&&) noexcept;
  RoundedItinerary& operator=(RoundedItinerary&&) noexcept;
  ~RoundedItinerary();

  /// The next obstacle; nothing where it hits none, or lies inside of one.
  std::optional<ObstacleId> next();

  struct Impl;

 private:
  Pimpl<Impl> impl_;
};

/// The nearest binary64 of every number: what programs make of the same problem. Beyond binary64's range an
/// infinity, which is a flaw (flaw_of). `degrees` become a velocity.
double nearest(const Rational& number);
Scene nearest(const RationalScene& scene);
Query nearest(const Start& start);

/// The library of intervals and its version.
std::string itinerary_libraries();

}  // namespace lorentz::oracle
