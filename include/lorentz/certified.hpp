// The engine `certified`: the fast engine's answer where that is certain, otherwise the oracle's.
#pragma once

#include <optional>

#include <lorentz/flight.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/reduction.hpp>

namespace lorentz::oracle {

/// Exact first hits, at nearly the speed of the fast engine where that decides, and at the oracle's speed
/// elsewhere.
///
///  1. The answer is that of Oracle::first_hit, to the bit of the time; it is never `undecided`.
///  2. Any number of threads may use one engine, each with its own tally.
///
/// Units: as in Query: lengths are in the scene's unit, and times are such that x + t v is the particle's
/// position.
///
/// Cost: that of the fast engine plus about 100 ns for the time. Where the fast engine is not certain, and
/// for scenes beyond it, the cost is that of the oracle (5 us and more). The oracle answers one in several
/// thousand drawn queries (docs/speed.md).
class Certified {
 public:
  /// Throws InputError if the scene is invalid (flaw_of) or has dependent vectors (dependence_in).
  explicit Certified(const Scene& scene);

  /// The exact answer. An invalid query yields `error`. If digits or detail are requested, the oracle
  /// answers, at its cost. `tally`, if given, counts which stage decided; its `undecided` counts the queries
  /// that the oracle answered.
  Answer first_hit(const Query& query, const Request& request = {}, StageTally* tally = nullptr) const;

  /// Writes the answer into an existing object and replaces whatever it held.
  void first_hit(const Query& query, const Request& request, Answer& answer,
                 StageTally* tally = nullptr) const;

 private:
  bool answer_fast(const Query& query, const Request& request, Answer& answer, StageTally* tally) const;

  Scene scene_;
  Oracle oracle_;
  std::optional<Reduction> fast_;  ///< empty if the scene is beyond the fast engine
};

}  // namespace lorentz::oracle
