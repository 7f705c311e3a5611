// The reduction engine: the first hit in O(log 1/r), by lattice reduction in binary64, that knows when it
// does not know.
#pragma once

#include <limits>
#include <memory>

#include <lorentz/engine.hpp>
#include <lorentz/flight.hpp>
#include <lorentz/pimpl.hpp>

namespace lorentz {

struct AtomDirections;  // of the engine's inside: a velocity as seen from each atom
struct Task;            // and what it is asked

/// The first obstacle on a flight, for one scene, in binary64.
///
/// What it promises, and which test holds it to that:
///  1. An outcome other than `undecided` is right, and so is the obstacle: those of the exact oracle.
///     held by "The reduction engine agrees with the oracle on drawn and constructed cases",
///             "Grazing hits: every stage decides, and none wrongly",
///             "Among ellipsoids the reduction engine agrees with the oracle on drawn and constructed cases",
///             "Limits within ulps of the time: what is not undecided is right, alone and in a batch"
///  2. The time of a drawn flight errs by at most 6 ulps among balls, 8 among ellipses and ellipsoids
///     (seen: 5 and 6), by more if the flight ends within some 1e-16 r of its start. It is correctly
///     rounded where `time_is_rounded` says so, for which one asks with Time::rounded. "Drawn": isotropic
///     from a uniform start. Of other flights no bound is promised: where the time matters, ask for it
///     rounded.
///     held by "Times of drawn flights err by few ulps, those said to be rounded not at all"
///  3. The same bits on every processor that computes in IEEE 754 binary64, with a fused multiply-add or
///     without, if it is compiled without contraction and fast-math, as this project's build files do.
///     held by "The reduction engine agrees with the oracle on drawn and constructed cases",
///             "lorentz doctor finds this machine fit, and says what it looked at"
///  4. The same bits along a prepared direction as without.
///     held by "The reduction engine agrees with the oracle on drawn and constructed cases",
///             "A prepared direction keeps the limit, at any speed"
///  5. `fly` allocates nothing, throws nothing, and ends: there is no loop without a bound.
///     held by "A flight allocates nothing, in any model"
///  6. Any number of threads may ask one engine, and share a direction.
///     held by "Many threads may ask one engine, oracle, walk and judge"
///  7. On drawn directions nothing is undecided (balls of radius 1e-12 of the spacing and more in 2D,
///     1e-7 in 3D).
///     held by "Nothing is undecided on drawn queries, down to the smallest radii"
///
/// Units: lengths are the scene's, times are such that x + t v is the particle's place. |v| is any.
///
/// Ranges: `beyond` says which scenes are not done (obstacles that overlap their own translates, or are
/// too small or too slender; very flat cells). Starts beyond 2^51 cells from the origin on the unit
/// lattices (is_unit_scene), 2^44 on others, are `undecided`, and so are obstacles beyond 2^53 cells from
/// the place where they are met. What is undecided, certified.hpp asks the oracle.
///
/// Cost: some 85 ns a flight in 2D and 420 ns in 3D at r = 0.1, about 13 ns and 115 ns more for each
/// factor of ten in 1/r (docs/speed.md); the constructor reduces the lattices and looks at every atom.
///
/// Source: this project. docs/reduction.md explains the method, docs/bounds.md why its decisions can be
/// trusted.
class Reduction : public Engine {
 public:
  /// With the fused multiply-add if the processor has it, or as if it had not: the same answers, to the bit.
  enum class Processor { this_one, without_fma };

  /// Throws InputError for a scene with a flaw, UnsupportedError for one that is beyond the engine. That its vectors
  /// are independent only exact arithmetic can say (oracle::dependence_in).
  explicit Reduction(const Scene& scene, Processor processor = Processor::this_one);
  ~Reduction() override;
  Reduction(Reduction&&) noexcept;
  Reduction& operator=(Reduction&&) noexcept;

  /// Why the engine does not do a scene without flaws ("does ... only"), or nothing.
  static std::optional<std::string> beyond(const Scene& scene);

  /// Which model serves the scene: "unit", "one atom" or "several atoms", each also with ", ellipsoid"
  /// (docs/reduction.md).
  const char* model() const;

  /// How exact a time is asked for: within a few ulps, or correctly rounded (where `time_is_rounded` says
  /// so), which costs some 100 ns more.
  enum class Time { close, rounded };

  /// The first obstacle, as a Flight: an answer without strings. Requires a query without flaws (flaw_of):
  /// this is asserted, and not checked where NDEBUG is defined. Outcomes: `hit`, `never`, `inside`, `undecided`, and with a finite `max_time`
  /// `later` in place of `never`: nothing is entered before it. The exact time decides that, also where the
  /// time that is told is rounded to the limit, or beyond it; a time too near the limit is `undecided`.
  Flight fly(const Query& query, double max_time = std::numeric_limits<double>::infinity(),
             Time time = Time::close) const;

  /// One velocity, prepared: for many particles that share it, the lattices are reduced once.
  class Direction;

  /// The lattices, reduced along v: finite, and not zero, which is asserted. For this engine only: keep it as long
  /// as the direction. Then a flight costs some 57 ns (2D) or 200 ns (3D), whatever the radius.
  /// Allocates.
  Direction direction(const Vec& v) const;
  /// The same for a prepared velocity; to the bit. `from`: as in Query, or null.
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

/// A velocity with all that one engine makes of it once; nothing until the engine's `direction` made it.
/// Cheap to copy; its copies share what was prepared.
class Reduction::Direction {
 private:
  friend class Reduction;
  Vec v_{}, scaled_v_{};
  int exponent_ = 0;
  std::shared_ptr<const AtomDirections> atoms_;
};

/// A flight as the answer that all engines give; or written into an answer that is as newly made
/// (Answer::clear), which saves its allocations.
Answer answer_of(const Flight& flight);
void set_answer(const Flight& flight, Answer& answer);

}  // namespace lorentz
