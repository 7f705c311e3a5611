// The reduction engine: first hits in O(log 1/r), by lattice reduction in binary64. It answers `undecided` if
// it does not know the answer.
#pragma once

#include <limits>
#include <memory>

#include <lorentz/engine.hpp>
#include <lorentz/flight.hpp>
#include <lorentz/pimpl.hpp>

namespace lorentz {

struct AtomDirections;  // internal to the engine: a velocity as seen from each atom
struct Task;            // internal to the engine: the query as it is asked

/// First hits in one scene, in binary64.
///
/// Promises, and the tests that hold the engine to them:
///  1. An outcome other than `undecided` is right, and so is the obstacle: they are those of the exact
///     oracle.
///     held by "The reduction engine agrees with the oracle on drawn and constructed cases",
///             "Grazing hits: every stage decides, and none wrongly",
///             "Among ellipsoids the reduction engine agrees with the oracle on drawn and constructed cases",
///             "Limits within ulps of the time: every decided answer is right, alone and in a batch"
///  2. The time of a drawn flight has an error of at most 6 ulps among balls, and 8 among ellipses and
///     ellipsoids (seen: 5 and 6). The error is larger if the flight ends within about 1e-16 r of its start.
///     If requested by Time::rounded, the time is correctly rounded where `time_is_rounded` says so. "Drawn"
///     means isotropic from a uniform start. For other flights no bound is promised: where the time matters,
///     request Time::rounded.
///     held by "Times of drawn flights err by few ulps, those said to be rounded not at all"
///  3. The bits are the same on every processor that computes in IEEE 754 binary64, with a fused multiply-add
///     or without, if the engine is compiled without contraction and fast-math, as this project's build files
///     do.
///     held by "The reduction engine agrees with the oracle on drawn and constructed cases",
///             "lorentz doctor finds this machine fit, and says what it looked at"
///  4. A prepared direction gives the same bits.
///     held by "The reduction engine agrees with the oracle on drawn and constructed cases",
///             "A prepared direction keeps the limit, at any speed"
///  5. `fly` allocates nothing, throws nothing and ends: every loop has a bound.
///     held by "A flight allocates nothing, in any model"
///  6. Any number of threads may use one engine, and share a direction.
///     held by "Many threads may ask one engine, oracle, walk and judge"
///  7. No query in a drawn direction is undecided (balls of radius at least 1e-12 of the spacing in 2D, 1e-7
///     in 3D).
///     held by "Nothing is undecided on drawn queries, down to the smallest radii"
///
/// Units: lengths are in the scene's unit; times are such that x + t v is the particle's position. |v| may
/// have any value.
///
/// Ranges: `beyond` says which scenes are not supported (obstacles that overlap their own translates, or are
/// too small or too slender; very flat cells). Starts beyond 2^51 cells from the origin on the unit lattices
/// (is_unit_scene), or 2^44 on others, are `undecided`. So are obstacles beyond 2^53 cells from the place
/// where they are met. `Certified` (certified.hpp) asks the oracle about undecided queries.
///
/// Cost: about 85 ns per flight in 2D and 420 ns in 3D at r = 0.1, and about 13 ns and 115 ns more for each
/// factor of ten in 1/r (docs/speed.md). The constructor reduces the lattices and examines every atom.
///
/// Source: this project. docs/reduction.md explains the method, docs/bounds.md why its decisions can be
/// trusted.
class Reduction : public Engine {
 public:
  /// Use the fused multiply-add if the processor has it, or do without. The answers are the same, to the bit.
  enum class Processor { this_one, without_fma };

  /// Throws InputError if the scene is invalid (flaw_of), UnsupportedError if it is beyond the engine. Only
  /// exact arithmetic can decide whether the vectors are independent (oracle::dependence_in).
  explicit Reduction(const Scene& scene, Processor processor = Processor::this_one);
  ~Reduction() override;
  Reduction(Reduction&&) noexcept;
  Reduction& operator=(Reduction&&) noexcept;

  /// Why the engine does not support a valid scene ("does ... only"), or nothing.
  static std::optional<std::string> beyond(const Scene& scene);

  /// The model that serves the scene: "unit", "one atom", "several atoms", "rows and layers" or "mixed"; with
  /// ellipsoids also ", ellipsoid" (the first two) or ", ellipsoids" (docs/reduction.md).
  const char* model() const;

  /// The accuracy of a time: within a few ulps, or correctly rounded (where `time_is_rounded` says so), which
  /// costs about 100 ns more.
  enum class Time { close, rounded };

  /// The first hit, as a Flight: an answer without strings. Requires a valid query (flaw_of); this is
  /// asserted, and not checked if NDEBUG is defined. The outcomes are `hit`, `never`, `inside` and
  /// `undecided`. With a finite `max_time`, `later` replaces `never`: nothing is entered before the limit.
  /// The exact time decides this, even if the reported time is rounded to the limit or beyond it. If the time
  /// is too near the limit, the outcome is `undecided`.
  Flight fly(const Query& query, double max_time = std::numeric_limits<double>::infinity(),
             Time time = Time::close) const;

  /// One prepared velocity: for many particles that share it, the lattices are reduced once.
  class Direction;

  /// Reduces the lattices along v, which must be finite and not zero (this is asserted). The direction is for
  /// this engine only; keep the engine as long as the direction. A flight then costs about 57 ns (2D) or 200
  /// ns (3D), whatever the radius. Allocates.
  Direction direction(const Vec& v) const;
  /// The same as the other `fly`, to the bit, for a prepared velocity. `from` is as in Query, or null.
  Flight fly(const Direction& direction, const Vec& x, const ObstacleId* from = nullptr,
             double max_time = std::numeric_limits<double>::infinity(), Time time = Time::close) const;

  struct Model;

 private:
  void first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const override;
  bool decides_limit() const override { return true; }
  void fly(const Ray& ray, const AtomDirections* directions, double max_time, Time time,
           Flight& flight) const;
  void fly_to_limit(Task task, Flight& flight) const;
  Pimpl<const Model> model_;
};

/// A velocity with everything that one engine prepares for it; empty until the engine's `direction` makes it.
/// It is cheap to copy: the copies share the prepared data.
class Reduction::Direction {
 private:
  friend class Reduction;
  Vec v_{}, scaled_v_{};
  int exponent_ = 0;
  std::shared_ptr<const AtomDirections> atoms_;
};

/// Turn a flight into the answer that all engines give. set_answer writes into an existing answer, which must
/// be as newly made (Answer::clear); this saves its allocations.
Answer answer_of(const Flight& flight);
void set_answer(const Flight& flight, Answer& answer);

}  // namespace lorentz
