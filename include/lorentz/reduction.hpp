// The reduction engine: the first hit in O(log 1/r), by lattice reduction in binary64, that knows when it
// does not know. docs/reduction.md explains the method, docs/bounds.md why its decisions can be trusted.
#pragma once

#include <limits>
#include <memory>

#include <lorentz/engine.hpp>
#include <lorentz/flight.hpp>

namespace lorentz {

struct AtomDirections;  // of the engine's inside: a velocity as seen from each atom

class Reduction : public Engine {
 public:
  /// With the fused multiply-add if the processor has it, or as if it had not: the same answers, to the bit.
  enum class Processor { this_one, without_fma };

  /// Throws std::invalid_argument for a scene that is beyond the engine.
  explicit Reduction(const Scene& scene, Processor processor = Processor::this_one);
  ~Reduction() override;

  /// Why the engine does not do a scene without flaws, or nothing.
  static std::optional<std::string> beyond(const Scene& scene);

  /// Which model serves the scene: "unit", "one atom" or "several atoms", each also with ", ellipsoid"
  /// (docs/reduction.md).
  const char* model() const;

  /// How exact a time is asked for: within a few ulps, or correctly rounded (where `time_is_rounded` says
  /// so).
  enum class Time { close, rounded };

  /// The answer without strings; for a query without flaws. Allocates nothing. `later` is not used: of a
  /// flight with nothing before `max_time` it says `never`, or names an obstacle that is entered after it,
  /// which need not be the first one. Starts too far away (2^51 cells on the unit lattices, 2^44 on others)
  /// are `undecided`.
  Flight fly(const Query& query, double max_time = std::numeric_limits<double>::infinity(),
             Time time = Time::close) const;

  /// One velocity, prepared: for many particles that share it, the lattices are reduced once.
  class Direction;

  /// For a finite v other than zero. Keep the engine as long as the direction.
  Direction direction(const Vec& v) const;
  Flight fly(const Direction& direction, const Vec& x, const ObstacleId* from = nullptr,
             double max_time = std::numeric_limits<double>::infinity(), Time time = Time::close) const;

  struct Model;

 private:
  void first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const override;
  void fly(const Ray& ray, const AtomDirections* directions, double max_time, Time time,
           Flight& flight) const;
  std::unique_ptr<const Model> model_;
};

class Reduction::Direction {
 private:
  friend class Reduction;
  Vec scaled_v_{};
  int exponent_ = 0;
  bool tiny_component_ = false;
  std::shared_ptr<const AtomDirections> atoms_;
};

/// An answer of the interface that all engines share; or into one that is there, and is as newly made.
Answer answer_of(const Flight& flight);
void set_answer(const Flight& flight, Answer& answer);

}  // namespace lorentz
