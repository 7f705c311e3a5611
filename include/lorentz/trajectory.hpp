// The path of a particle from collision to collision, with any engine for the flights.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include <lorentz/engine.hpp>
#include <lorentz/pimpl.hpp>

namespace lorentz {

/// Where a particle is and how it moves: in the frame of an obstacle, so that the digits that it has don't
/// depend on how far it went. Numbers have two parts, whose sum is meant; in binary64 the low ones are zero,
/// but for the time's.
struct Particle {
  std::int32_t lattice = 0, atom = 0;  ///< the obstacle that the offset counts from,
  std::array<std::int64_t, 3> cell{};  ///< in this cell
  bool leaves = false;                 ///< it comes from that obstacle, which the next flight ignores

  Vec offset{}, offset_low{};                       ///< from the obstacle's centre, in the scene's unit
  Vec velocity{}, velocity_low{};                   ///< after the collision; any length
  double speed_squared = 0, speed_squared_low = 0;  ///< what the velocity's square was at the start

  double time = 0, time_low = 0;  ///< since the start, in units in which x + t v is the place
  std::uint64_t collisions = 0;   ///< since the start
};

/// What numbers a state is kept in.
enum class Precision {
  binary64,
  double_double  ///< 106 bits
};

/// Why a particle does not go on.
enum class Stop {
  none,        ///< it does
  collisions,  ///< it made as many as were asked for
  time,        ///< the time that was asked for has come; it is where it is then
  condition,   ///< the visitor wished it
  never,       ///< it flies on for ever; from rows, layers and single obstacles particles escape
  later,       ///< so says the engine, of a flight without a limit
  inside,      ///< it lies in an obstacle: a start, or a corner between obstacles that touch or overlap
  undecided,   ///< the engine does not know what is hit next
  missed,      ///< the obstacle that the engine named is not on the line of flight, beyond all rounding
  overflow,    ///< the next obstacle's cell is beyond 64 bits, or 2^53 cells from where it is seen
  error        ///< the engine cannot answer: message() says why
};

/// "never", "undecided", ..
const char* name_of(Stop stop);

/// A collision, as it happened.
struct Collision {
  double flight = 0;  ///< time since the one before, the start, or a halt at a time
  Vec arriving{};     ///< the velocity before
  Vec normal{};       ///< outward, of unit length up to rounding
  double cosine = 0;  ///< of the angle between the velocity after and the normal
};

/// First hits, by whoever is asked: the query, what comes after `max_time` is not wanted, the answer.
using AskFirstHit = std::function<void(const Query& query, double max_time, Answer& answer)>;

/// A particle that flies, and is reflected by the obstacles that it meets: the angle of reflection is that of
/// incidence, the speed is kept.
///
///  1. Each collision is that of the state before it, with the obstacle that the engine named, computed from
///     that obstacle alone and not from the engine's time. The offset errs by some u times the flight's
///     length, the direction by that over the radius, both times 1 / cosine; u is 2^-53 in binary64, 2^-102
///     in double_double. Of ellipsoids also times the ratio of their semiaxes.
///     held by "A collision is the oracle's, as exact as the state",
///             "A collision in binary64 is that in double-double, rounded",
///             "Problem 2 of the 100-digit challenge: the digits that each precision has"
///  2. After each collision the particle is on the obstacle's surface and has its first speed, both up to
///     some ulps, however many collisions there were.
///     held by "Speed and surface are kept over many collisions"
///  3. No digit is lost to the distance travelled: the flight is asked in a frame in which the obstacle that
///     is left lies in cell 0. Of superposed lattices there is no such frame, and the flight is asked in the
///     scene's own; then what is asked is rounded to an ulp of the distance from the origin.
///     held by "Far from the origin a trajectory is the same, to the bit"
///  4. In double_double the engine sees the state rounded to binary64. It may so take a line that passes an
///     obstacle for one that grazes it, or the other way round. The first is a collision with cosine 0 that
///     changes no velocity; the second is not noticed. That is what 2^-50 of the flight's length decides.
///     held by "A line that grazes goes on unchanged"
///  5. Whatever happens, it stops and says why (Stop); the state is then that of the last collision, or that
///     at the time asked for. Nothing is thrown but by the engine, a constructor, or set_state.
///     held by "A trajectory that ends says why"
///  6. Constant memory: nothing is kept of the past.
///
/// Units: those of the scene; |v| is any from 2^-100 to 2^100, and so are sizes of obstacles and vectors.
///
/// Overlapping obstacles are allowed where the engine allows them. Once in some 10^15 collisions a particle
/// is so near to a corner that rounding puts it inside.
///
/// Source: this project. The reflection is the textbook one: at the point A y, |y| = 1, of an ellipsoid it
/// turns the part of v along A^-T y round.
class Trajectory {
 public:
  /// From the start of a query: at x, with the velocity v, off `from` if there is one. `engine` must live as
  /// long, and be the scene's; a Reduction is asked without detours. Throws InputError for a
  /// scene or start with a flaw (flaw_of), UnsupportedError for sizes beyond its range.
  Trajectory(const Engine& engine, const Scene& scene, const Query& start,
             Precision precision = Precision::binary64);

  /// The same with somebody else for the flights.
  Trajectory(AskFirstHit ask, const Scene& scene, const Query& start,
             Precision precision = Precision::binary64);

  ~Trajectory();
  Trajectory(Trajectory&&) noexcept;
  Trajectory& operator=(Trajectory&&) noexcept;

  const Particle& state() const { return particle_; }

  /// Takes another state in its place: one of another trajectory in this scene, say, to go on with it. One
  /// with low parts makes a start of more than 53 bits. Throws InputError for one that names an
  /// obstacle that is not there, or has no velocity or speed_squared.
  void set_state(const Particle& particle);

  /// Makes one collision, unless it came after the time `until`: then the particle is brought to where it is
  /// at `until`, and can go on from there; never back in time. False: there was no collision, and stop() says
  /// why.
  bool advance(double until = std::numeric_limits<double>::infinity());

  /// The last collision.
  const Collision& collision() const { return collision_; }

  Stop stop() const { return stop_; }
  const std::string& message() const { return message_; }  ///< of `error`

  /// Collisions until there were so many since the start, or the time has come, or `visit(*this)`, called
  /// after each collision, is false.
  template <class Visit>
  Stop run(std::uint64_t collisions, double until, const Visit& visit) {
    while (particle_.collisions < collisions) {
      if (!advance(until)) return stop_;
      if (!visit(*this)) return stop_ = Stop::condition;
    }
    return stop_ = Stop::collisions;
  }

  /// The place in the scene's coordinates, rounded.
  Vec place() const;

 private:
  template <class Motion>
  Stop advance(const Motion& motion, double until);

  struct Inside;
  Pimpl<Inside> inside_;
  Particle particle_;
  Collision collision_;
  Stop stop_ = Stop::none;
  std::string message_;
};

/// The state at the start of a query. Throws as Trajectory's constructor does.
Particle particle_at(const Scene& scene, const Query& start, Precision precision = Precision::binary64);

/// Where a particle is in the scene's coordinates, rounded.
Vec place_of(const Scene& scene, const Particle& particle);

/// From one place to another, rounded once: exact where both are far from the origin.
Vec displacement(const Scene& scene, const Particle& from, const Particle& to);

}  // namespace lorentz
