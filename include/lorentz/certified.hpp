// The engine `certified`: the fast engine's answer where that is certain, the oracle's where it is not.
// Always exact, at nearly the speed of the fast one.
#pragma once

#include <optional>

#include <lorentz/flight.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/reduction.hpp>

namespace lorentz::oracle {

class Certified {
 public:
  /// The scene must have no flaw (flaw_of) and independent vectors (dependence_in).
  explicit Certified(const Scene& scene);

  /// What Oracle::first_hit answers, to the bit. `digits` and `detail` are the oracle's work alone. `tally`,
  /// if given, counts which stage decided; `undecided` are the queries that the oracle answered. Safe to call
  /// from several threads (each with its own tally).
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
