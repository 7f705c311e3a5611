// The motion of a particle in one scene: the query for its next flight, and the collision with the obstacle
// that an engine names. Private to src/trajectory.
#pragma once

#include <optional>
#include <tuple>
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
  template <class In>
  struct Obstacle {
    Point<In> position;
    MeetingShape<In> shape;
  };
  template <class In>
  struct MotionRows {
    MotionRows(const Lattice& lattice, int dimension);

    std::array<Point<In>, 3> vectors;
    std::vector<Obstacle<In>> obstacles;
  };

  template <class In>
  const MotionRows<In>& rows(std::size_t lattice) const {
    return std::get<std::vector<MotionRows<In>>>(rows_)[lattice];
  }
  std::optional<std::array<std::int64_t, 3>> cell_of(const Particle& particle, const Flight& named) const;
  template <class In>
  Point<In> step_to(const Particle& particle, const Flight& named,
                    const std::array<std::int64_t, 3>& cell) const;
  template <class In>
  Stop meet(Particle& particle, const Inquiry& asked, const Flight& named, double until,
            Collision& collision) const;

  Places places_;
  bool one_lattice_;
  /// For collisions that binary64 places well, and for others.
  std::tuple<std::vector<MotionRows<double>>, std::vector<MotionRows<Wide>>> rows_;
};

extern template class Motion<double>;
extern template class Motion<Wide>;

/// Motion with states in the numbers of a precision.
struct AnyMotion : std::variant<Motion<double>, Motion<Wide>> {
  AnyMotion(const Scene& scene, Precision precision);
  const Places& places() const;
};

}  // namespace lorentz
