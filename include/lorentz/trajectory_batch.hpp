// The paths of many particles at once: their flights in the lanes of the processor's vectors.
#pragma once

#include <cstddef>
#include <vector>

#include <lorentz/batch.hpp>
#include <lorentz/pimpl.hpp>
#include <lorentz/trajectory.hpp>

namespace lorentz {

/// Particles in one scene that don't see each other, each as a Trajectory with a Reduction has it.
///
///  1. What Trajectory says of each, to the bit, however many there are.
///     held by "Particles in a batch go where each goes alone, to the bit"
///  2. One that stops disturbs no other.
///     held by "Particles in a batch stop one by one"
///  3. Constant memory: `advance` allocates nothing.
///     held by "Many collisions take no memory"
///  4. One set is for one thread; any number of them may share an engine.
///
/// Units, ranges and exactness: those of Trajectory.
class Particles {
 public:
  /// `engine` is the scene's, and must live as long. Throws as Trajectory does.
  Particles(const Batch& engine, const Scene& scene, Precision precision = Precision::binary64);
  ~Particles();
  Particles(Particles&&) noexcept;
  Particles& operator=(Particles&&) noexcept;

  /// Another particle, at the start of a query or in any state. Throws as Trajectory does.
  void add(const Query& start);
  void add(const Particle& particle);
  void clear();

  std::size_t size() const { return particles_.size(); }
  const Particle& operator[](std::size_t i) const { return particles_[i]; }
  Stop stop(std::size_t i) const { return stops_[i]; }  ///< `none`: it goes on

  /// How many go on.
  std::size_t going() const { return going_.size(); }

  /// One collision of each that goes on, as Trajectory::advance makes it; calls `visit(i, particle,
  /// collision)` after each. A particle of which that is false stops by `condition`. Returns going().
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

  /// Those that stopped at a time, or by a condition, go on from where they are.
  void resume();

 private:
  /// So many that what they need stays in the nearest cache.
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
