// The engine `certified`: the fast engine's answer where that is certain, the oracle's where it is not.
#pragma once

#include <optional>

#include <lorentz/flight.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/reduction.hpp>

namespace lorentz::oracle {

/// First hits, always exact, at nearly the speed of the fast engine.
///
///  1. What Oracle::first_hit answers, to the bit of the time; never `undecided`.
///     held by "certified is the oracle, to the bit",
///             "certified is exact among ellipsoids, whatever the engine says of them",
///             "A hit is before a limit iff its exact time is, and certified says what the oracle says"
///  2. Any number of threads may ask one, each with a tally of its own.
///     held by "Many threads may ask one engine, oracle, walk and judge"
///
/// Units: as in Query: lengths are the scene's, times are such that x + t v is the particle's place.
/// Cost: that of the fast engine and some 100 ns for the time; where it is not certain, and for scenes
/// beyond it, that of the oracle (5 us and more). On drawn queries that is one in some thousand
/// (docs/speed.md).
class Certified {
 public:
  /// Throws InputError for a scene with a flaw (flaw_of) or dependent vectors (dependence_in).
  explicit Certified(const Scene& scene);

  /// The exact answer; an invalid query yields `error`. A request for digits or detail is
  /// answered by the oracle, at its cost.
  /// `tally`, if given, counts which stage decided; `undecided` are the queries that the oracle answered.
  Answer first_hit(const Query& query, const Request& request = {}, StageTally* tally = nullptr) const;

  /// The same into an answer that is there already; whatever it held is replaced.
  void first_hit(const Query& query, const Request& request, Answer& answer,
                 StageTally* tally = nullptr) const;

 private:
  bool answer_fast(const Query& query, const Request& request, Answer& answer, StageTally* tally) const;

  Scene scene_;
  Oracle oracle_;
  std::optional<Reduction> fast_;  ///< nothing: the scene is beyond it
};

}  // namespace lorentz::oracle
