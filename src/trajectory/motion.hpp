// The motion of a particle in one scene: the query for its next flight, and the collision with the obstacle
// that an engine names. Private to src/trajectory.
#pragma once

#include <variant>
#include <vector>

#include <lorentz/flight.hpp>
#include <lorentz/trajectory.hpp>
#include "src/trajectory/meeting.hpp"

namespace lorentz {

/// The start of a flight as the engine is asked about it, and the cell of the obstacle that the particle
/// leaves.
struct Inquiry {
  Vec x, v;
  std::array<std::int64_t, 3> cell;
};

/// The time limit for the engine: a little more than the time left, so that rounding hides no collision
/// within it.
inline double flight_limit(const Particle& particle, double until) {
  return until < HUGE_VAL ? std::fmax(0, until - particle.time) * (1 + 0x1p-30) + 0x1p-1000 : HUGE_VAL;
}

/// The geometry of a scene whose lengths are in range.
class Places {
 public:
  /// Throws InputError or UnsupportedError.
  explicit Places(const Scene& scene);

  const Scene& scene() const { return scene_; }
  Particle at(const Query& start, Precision precision) const;
  /// Throws InputError if the particle's state is not valid in this scene.
  void check(const Particle& particle) const;
  void check_obstacle(const Particle& particle) const;
  Point<Wide> centre(std::int32_t lattice, std::int32_t atom, const std::array<std::int64_t, 3>& cell) const;
  Point<Wide> place(const Particle& particle) const;

 private:
  void set_home(const Query& start, Particle& particle) const;

  Scene scene_;
};

/// Motion with states in double or Wide. It is const, so any number of threads may share one.
template <class Real>
class Motion {
 public:
  explicit Motion(const Scene& scene);

  const Places& places() const { return places_; }

  Inquiry asked(const Particle& particle) const;

  /// Ends the flight as the engine says: makes the collision with the obstacle, whose cell is in the frame in
  /// which the query was asked; or, if nothing is met before the time `until`, moves the particle to its
  /// position then. If `until` is infinite, the particle stays, and the result is `never` or `later`.
  Stop end(Particle& particle, const Inquiry& asked, const Flight& flight, double until,
           Collision& collision) const;

 private:
  struct Obstacle {
    Point<Real> position;
    MeetingShape<Real> shape;
  };
  struct MotionRows {
    std::array<Point<Real>, 3> vectors;
    std::vector<Obstacle> obstacles;
  };

  Stop meet(Particle& particle, const Inquiry& asked, const Flight& named, double until,
            Collision& collision) const;
  bool see(const Particle& particle, const Flight& named, Point<Real>& w,
           std::array<std::int64_t, 3>& cell) const;
  Point<Real> step_at_home(const Particle& particle, const Flight& named) const;
  Point<Real> step_in_scene(const Particle& particle, const Flight& named) const;

  Places places_;
  bool one_lattice_;
  std::vector<MotionRows> lattices_;
};

extern template class Motion<double>;
extern template class Motion<Wide>;

/// Motion with states in the numbers of a precision.
struct AnyMotion : std::variant<Motion<double>, Motion<Wide>> {
  AnyMotion(const Scene& scene, Precision precision);
  const Places& places() const;
};

}  // namespace lorentz
