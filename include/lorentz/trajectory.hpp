// The path of a particle from collision to collision. Any engine can compute the flights.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include <lorentz/engine.hpp>
#include <lorentz/pimpl.hpp>

namespace lorentz {

/// The position and velocity of a particle. The position is relative to an obstacle, so that its precision
/// does not depend on the distance travelled. Each number is the sum of two parts. In binary64 the low parts
/// are zero, except that of the time.
struct Particle {
  std::int32_t lattice = 0, atom = 0;  ///< the obstacle from which the offset counts,
  std::array<std::int64_t, 3> cell{};  ///< in this cell
  bool leaves = false;                 ///< the particle leaves that obstacle, and the next flight ignores it

  Vec offset{}, offset_low{};                       ///< from the obstacle's centre, in the scene's unit
  Vec velocity{}, velocity_low{};                   ///< after the collision; any length
  double speed_squared = 0, speed_squared_low = 0;  ///< the square of the velocity at the start

  double time = 0, time_low = 0;  ///< since the start, in units in which x + t v is the position
  std::uint64_t collisions = 0;   ///< since the start
};

/// The numbers in which a state is kept.
enum class Precision {
  binary64,
  double_double  ///< 106 bits
};

/// Why a particle stopped.
enum class Stop {
  none,        ///< it has not stopped
  collisions,  ///< it made the requested number of collisions
  time,        ///< the requested time has come; the particle is where it is at that time
  condition,   ///< the visitor returned false
  never,       ///< it flies on for ever; particles escape from rows, layers and single obstacles
  later,       ///< the engine answered `later` to a flight without a limit
  inside,      ///< it lies in an obstacle: at the start, or in a corner of obstacles that touch or overlap
  undecided,   ///< the engine does not know the next obstacle
  missed,      ///< the obstacle that the engine named is not on the line of flight, beyond all rounding
  overflow,    ///< the next obstacle's cell is beyond 64 bits, or it is too far away for its size: 1, 3, 4
  error        ///< the engine cannot answer: message() says why
};

/// "never", "undecided", ..
const char* name_of(Stop stop);

/// Data of one collision.
struct Collision {
  double flight = 0;  ///< time since the previous collision, the start, or a stop at a requested time
  Vec arriving{};     ///< the velocity before the collision
  Vec normal{};       ///< outward, of unit length up to rounding
  double cosine = 0;  ///< of the angle between the normal and the velocity after the collision
};

/// Answers a query. Hits after `max_time` are not needed.
using AskFirstHit = std::function<void(const Query& query, double max_time, Answer& answer)>;

/// A particle that flies and is reflected by the obstacles that it hits. The angle of reflection equals the
/// angle of incidence, and the speed is kept.
///
///  1. Each collision follows from the state before it and the obstacle that the engine named. It is computed
///     from that obstacle alone, not from the engine's time. The error of the offset is of the order of u
///     times the flight's length; that of the direction is this divided by the radius; both times 1 / cosine.
///     Here u is 2^-53 in binary64 and 2^-102 in double_double. For ellipsoids, both are also multiplied by
///     the ratio of the semiaxes. A collision for which u in binary64 is too coarse (2^-20 of the radius, as
///     on flights 2^33 times as long) is computed with 106 bits and then rounded: the state stays one that
///     fits the obstacle.
///  2. After each collision the particle is on the obstacle's surface and has its initial speed, both up to a
///     few ulps, however many collisions there were.
///  3. The distance travelled costs no digits, because the engine is asked in a frame in which the obstacle
///     that the particle leaves lies in cell 0. Superposed lattices have no such frame. There the engine is
///     asked in the scene's own frame, and the query is rounded to an ulp of the distance from the origin.
///     Where that is more than about 2^-10 of the obstacle's size, the particle stops (`overflow`).
///  4. In double_double the engine gets the state rounded to binary64. So it may take a line that passes an
///     obstacle for one that grazes it, or the other way round. The first is a collision with cosine 0, which
///     does not change the velocity; the second goes unnoticed. This can happen only where 2^-50 of the
///     flight's length decides. Where 2^-53 of it is more than 2^-10 of the obstacle's size, the particle stops
///     (`overflow`).
///  5. Whatever happens, the particle stops with a reason (Stop). The state is then that of the last
///     collision, or that at the requested time. Only the engine, a constructor or set_state can throw.
///  6. Constant memory: the past is not kept.
///
/// Units: those of the scene. |v|, the sizes of obstacles and the vectors' lengths may be from 2^-100 to
/// 2^100.
///
/// Overlapping obstacles are allowed where the engine allows them. About once in 10^15 collisions a particle
/// is so near to a corner that rounding puts it inside an obstacle.
///
/// Source: this project. The reflection is the textbook one: at the point A y, |y| = 1, of an ellipsoid it
/// reverses the part of v along A^-T y.
class Trajectory {
 public:
  /// Starts as a query does: at x, with velocity v, leaving `from` if it is set. `engine` must be the
  /// scene's, and must outlive the trajectory. If it is a Reduction, its `fly` is called directly. Throws
  /// InputError if the scene or the start is invalid (flaw_of), UnsupportedError if sizes are out of range.
  Trajectory(const Engine& engine, const Scene& scene, const Query& start,
             Precision precision = Precision::binary64);
  Trajectory(const Engine&& temporary, const Scene&, const Query&, Precision = Precision::binary64) = delete;

  /// The same, with a function that answers the queries.
  Trajectory(AskFirstHit ask, const Scene& scene, const Query& start,
             Precision precision = Precision::binary64);

  ~Trajectory();
  Trajectory(Trajectory&&) noexcept;
  Trajectory& operator=(Trajectory&&) noexcept;

  const Particle& state() const { return particle_; }

  /// Replaces the state, for example by that of another trajectory in this scene, to continue it. Low parts
  /// make a start of more than 53 bits possible. Throws InputError, which names the member, if the state
  /// names an obstacle that does not exist, or if a number is not finite or out of range.
  void set_state(const Particle& particle);

  /// Makes one collision, unless it would come after the time `until`. In that case the particle moves to its
  /// position at `until`, never back in time, and can continue from there. Returns false if there was no
  /// collision; stop() says why.
  bool advance(double until = std::numeric_limits<double>::infinity());

  /// The last collision.
  const Collision& collision() const { return collision_; }

  Stop stop() const { return stop_; }
  const std::string& message() const { return message_; }  ///< set for `error`

  /// Makes collisions until there are `collisions` of them since the start, or the time `until` has come, or
  /// `visit(*this)`, called after each collision, returns false.
  template <class Visit>
  Stop run(std::uint64_t collisions, double until, const Visit& visit) {
    while (particle_.collisions < collisions) {
      if (!advance(until)) return stop_;
      if (!visit(*this)) return stop_ = Stop::condition;
    }
    return stop_ = Stop::collisions;
  }

  /// The position in the scene's coordinates, rounded.
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

/// The position of a particle in the scene's coordinates, rounded. Throws InputError if the state names an
/// obstacle that does not exist.
Vec place_of(const Scene& scene, const Particle& particle);

/// The vector from one particle's position to the other's, rounded once, and so exact even if both are far
/// from the origin. Throws as place_of does.
Vec displacement(const Scene& scene, const Particle& from, const Particle& to);

}  // namespace lorentz
