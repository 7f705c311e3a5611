// The paths of many particles at once, with their flights in the lanes of the processor's vectors.
#pragma once

#include <cstddef>
#include <vector>

#include <lorentz/batch.hpp>
#include <lorentz/pimpl.hpp>
#include <lorentz/trajectory.hpp>

namespace lorentz {

/// Particles in one scene that do not interact. Each moves as in a Trajectory with a Reduction.
///
///  1. Each particle moves as Trajectory says, to the bit, however many particles there are.
///  2. A particle that stops does not affect the others.
///  3. Constant memory: `advance` allocates nothing.
///  4. One set of particles is for one thread; any number of sets may share an engine.
///
/// Units, ranges and exactness: as for Trajectory.
class Particles {
 public:
  /// `engine` must be the scene's, and must outlive this object. Throws what Trajectory throws.
  Particles(const Batch& engine, const Scene& scene, Precision precision = Precision::binary64);
  Particles(const Batch&& temporary, const Scene&, Precision = Precision::binary64) = delete;
  ~Particles();
  Particles(Particles&&) noexcept;
  Particles& operator=(Particles&&) noexcept;

  /// Adds a particle, at the start of a query or in any state. Throws what Trajectory throws.
  void add(const Query& start);
  void add(const Particle& particle);
  void clear();

  std::size_t size() const { return particles_.size(); }
  const Particle& operator[](std::size_t i) const { return particles_[i]; }
  Stop stop(std::size_t i) const { return stops_[i]; }  ///< `none` if it has not stopped

  /// The number of particles that have not stopped.
  std::size_t going() const { return going_.size(); }

  /// Makes one collision for each particle that has not stopped, as Trajectory::advance does, and then calls
  /// `visit(i, particle, collision)`. If `visit` returns false, the particle stops with `condition`. Returns
  /// going().
  template <class Visit>
  std::size_t advance(double until, const Visit& visit) {
    for (std::size_t begin = 0; begin < going_.size(); begin += kTogether) {
      const std::size_t count = fly(begin, until);
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = going_[begin + k];
        if (stops_[i] == Stop::none && !visit(i, particles_[i], collisions_[k])) stops_[i] = Stop::condition;
      }
    }
    return leave_stopped();
  }

 private:
  /// Number of particles flown together: few enough that their data stays in the nearest cache.
  static constexpr std::size_t kTogether = 128;

  std::size_t fly(std::size_t begin, double until);
  std::size_t leave_stopped();

  struct Inside;
  Pimpl<Inside> inside_;
  std::vector<Particle> particles_;
  std::vector<Stop> stops_;
  std::vector<std::size_t> going_;
  std::vector<Collision> collisions_;
};

}  // namespace lorentz
