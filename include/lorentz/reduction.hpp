// The reduction engine: first hits in O(log 1/r), by lattice reduction in binary64. Where its error bounds do
// not decide, it answers `undecided`.
#pragma once

#include <limits>
#include <memory>

#include <lorentz/engine.hpp>
#include <lorentz/flight.hpp>
#include <lorentz/pimpl.hpp>

namespace lorentz {

struct Task;  // internal: a query with its limit, in the engine's units

/// First hits in one scene, in binary64.
///
/// Below, a random query has a random start near the origin, a random direction, and no time limit.
///
/// Promises, and the tests that hold the engine to them:
///  1. An outcome other than `undecided` is right, and so is the obstacle of a `hit` or `inside`. Right means
///     that the exact oracle says the same.
///  2. If `fly` is called with Time::rounded (below) and sets Flight::time_is_rounded, the time is correctly
///     rounded. For all other times no error bound is promised (see "Errors of times" below).
///  3. The bits are the same on every processor that computes in IEEE 754 binary64, with a fused multiply-add
///     or without. This requires that the compiler does not fuse a product and a sum by itself, and does not
///     use fast-math. This project's build files see to both.
///  4. `fly` allocates nothing, throws nothing and ends: every loop has a bound.
///  5. Any number of threads may use one engine.
///  6. On the unit square and cubic lattices random queries are decided. There is one exception: a query may
///     be undecided if its exact answer is `never`. (Few random queries have this answer.) The test asks 3000
///     queries at each of 8 radii in the square lattice, the smallest 1e-12. In the cubic lattice it does so
///     at 6 radii, the smallest 1e-7.
///
/// Units: lengths are in the scene's unit; times are such that x + t v is the particle's position. |v| may
/// have any value.
///
/// Errors of times: a time that is not known to be correctly rounded errs by few ulps in random queries. At
/// most 5 ulps were seen among balls, and 6 among ellipses and ellipsoids; the test of promise 2 allows 6 and
/// 8. The error can be larger if the obstacle is hit within about 1e-16 r of the start.
///
/// Ranges: the engine does not support scenes with very flat cells, or with obstacles that are too small, too
/// slender, or reach over many cells. `beyond` tells whether a scene is supported.
///
/// These queries are `undecided`:
///  - queries with numbers so small that products of them underflow, and that the error bounds do not decide;
///  - queries that start more than 2^51 cells from the origin on a unit lattice (is_unit_scene), or more than
///    2^44 cells on another lattice;
///  - queries for which the search needs integers beyond 2^53 (2^76 among balls on the unit cubic lattice): very
///    long flights in a direction near a rational one.
/// `Certified` (certified.hpp) asks the oracle about undecided queries.
///
/// Cost: about 85 ns per flight in 2D and 420 ns in 3D at r = 0.1, and about 13 ns (2D) or 115 ns (3D) more
/// for each factor of ten in 1/r (docs/speed.md). The constructor finds short bases of the lattices (lattice
/// reduction), and examines every atom.
///
/// Source: this project. docs/reduction.md explains the method, docs/bounds.md why its decisions can be
/// trusted.
class Reduction : public Engine {
 public:
  /// this_one: use the fused multiply-add (FMA) if this processor has it. without_fma: never use it. The
  /// answers are the same, to the bit.
  enum class Processor { this_one, without_fma };

  /// Throws InputError if the scene is invalid (flaw_of), UnsupportedError if the engine does not support it.
  /// Does not check that the lattice vectors are independent: oracle::dependence_in does, in exact
  /// arithmetic.
  explicit Reduction(const Scene& scene, Processor processor = Processor::this_one);
  ~Reduction() override;
  Reduction(Reduction&&) noexcept;
  Reduction& operator=(Reduction&&) noexcept;

  /// Empty if the engine supports the scene. Otherwise says in words why it does not. Requires a valid scene.
  static std::optional<std::string> beyond(const Scene& scene);

  /// The name of the model (docs/reduction.md) that the engine uses for the scene: "unit", "one atom",
  /// "rows and layers" or "several atoms". With ellipsoids the first two end with ", ellipsoid", the
  /// others with ", ellipsoids".
  const char* model() const;

  /// The accuracy of a time. close: without a promised bound (see "Errors of times"). rounded: correctly
  /// rounded where Flight::time_is_rounded says so; costs about 100 ns more.
  enum class Time { close, rounded };

  /// The first hit, as a Flight: an answer without strings. Requires a valid query (flaw_of); this is
  /// asserted, and not checked if NDEBUG is defined. The outcomes are `hit`, `never`, `inside` and
  /// `undecided`.
  ///
  /// With a finite limit `max_time`, the outcome is `later` if nothing is entered before the limit, whether
  /// or not something is entered afterwards; `never` does not occur. The exact time of the hit is compared
  /// with the limit. (Rounding may move the reported time to the limit or beyond.)
  ///
  /// A hit in a cell that 64 bits do not hold is `undecided`; but if `cell` is not null, it is a hit with
  /// Flight::is_far, and `cell` gets the cell.
  Flight fly(const Query& query, double max_time = std::numeric_limits<double>::infinity(),
             Time time = Time::close, std::array<WideInteger, 3>* cell = nullptr) const;

  struct Model;

 private:
  void first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const override;
  bool decides_limit() const override { return true; }
  void fly(const Ray& ray, double max_time, Time time, Flight& flight,
           std::array<WideInteger, 3>* cell) const;
  void fly_to_limit(Task task, Flight& flight) const;
  Pimpl<const Model> model_;
};

/// Turn a flight into an Answer, the form that all engines share. set_answer writes into the caller's Answer,
/// which must be new or cleared. Answer::clear keeps the memory, so one Answer can serve many flights.
/// `cell`: as `fly` has set it, for a flight that is_far.
Answer answer_of(const Flight& flight);
void set_answer(const Flight& flight, Answer& answer);
void set_answer(const Flight& flight, const std::array<WideInteger, 3>& cell, Answer& answer);

}  // namespace lorentz
