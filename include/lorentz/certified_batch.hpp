// The engine `certified-batch`: many flights at once. Each result is right and its time correctly rounded, or
// the query is reported as one for the oracle.
#pragma once

#include <optional>
#include <vector>

#include <lorentz/batch.hpp>
#include <lorentz/certified.hpp>

namespace lorentz::oracle {

/// First hits of many queries in one scene.
///
///  1. A query that is not in `uncertain` gets the answer of Certified::first_hit, to the bit of the time.
///     held by "What a certified batch is certain of is what certified says, to the bit"
///  2. Any number of threads may use one engine.
///     held by "Threads share a batch engine"
///
/// Units: as in QueryColumns. Cost: that of Batch with rounded times. Fewer than one in 10 000 drawn queries
/// are `uncertain`; in a scene that Reduction does not support, all are.
class CertifiedBatch {
 public:
  /// Throws InputError if the scene is invalid (flaw_of) or has dependent vectors (dependence_in).
  explicit CertifiedBatch(const Scene& scene);

  /// Answers the queries on `jobs` threads. The columns must include `outcome`, `time` and `time_is_rounded`;
  /// throws InputError for invalid columns. A query has the outcome `later` if nothing is entered before its
  /// limit. `uncertain` receives, in order, the indices of the queries for which the oracle must be asked
  /// (Certified::first_hit); their outcome is `undecided`, and their other columns hold no answer.
  void first_hits(const QueryColumns& queries, const FlightColumns& flights,
                  std::vector<std::size_t>& uncertain, int jobs = 1) const;

  const Certified& one_at_a_time() const { return certified_; }

 private:
  Certified certified_;
  int dimension_;
  std::optional<Batch> batch_;  ///< empty if the scene is beyond the fast engine
};

}  // namespace lorentz::oracle
