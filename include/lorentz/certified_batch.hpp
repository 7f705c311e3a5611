// The engine `certified-batch`: many flights at once, each right and its time correctly rounded, or named as
// one for the oracle.
#pragma once

#include <optional>
#include <vector>

#include <lorentz/batch.hpp>
#include <lorentz/certified.hpp>

namespace lorentz::oracle {

/// First hits of many queries in one scene.
///
///  1. What is not named in `uncertain` is what Certified::first_hit answers, to the bit of the time.
///     held by "What a certified batch is certain of is what certified says, to the bit"
///  2. Any number of threads may ask one.
///     held by "Threads share a batch engine"
///
/// Units: as in QueryColumns. Cost: that of Batch with rounded times; `uncertain` are, of drawn queries, one
/// in some thousand (docs/speed.md).
class CertifiedBatch {
 public:
  /// Throws InputError for a scene with a flaw (flaw_of) or dependent vectors (dependence_in).
  explicit CertifiedBatch(const Scene& scene);

  /// Answers the queries on `jobs` threads; columns must include `outcome`, `time` and `time_is_rounded`. Throws
  /// InputError for columns with a flaw. A query with a limit before which nothing is entered is `later`. `uncertain`: the
  /// numbers of the queries that the oracle has to be asked (Certified::first_hit), in order; of these the
  /// columns say nothing.
  void first_hits(const QueryColumns& queries, const FlightColumns& flights,
                  std::vector<std::size_t>& uncertain, int jobs = 1) const;

  const Certified& one_at_a_time() const { return certified_; }

 private:
  Certified certified_;
  int dimension_;
  std::optional<Batch> batch_;  ///< nothing: the scene is beyond the fast engine
};

}  // namespace lorentz::oracle
