// The engines `certified-batch` and `gpu`: many flights at once. Each result is right and its time correctly
// rounded, or the query is reported as one for the oracle.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <lorentz/batch.hpp>
#include <lorentz/certified.hpp>

namespace lorentz::gpu {
class GpuBatch;
}

namespace lorentz::oracle {

/// First hits of many queries in one scene.
///
///  1. A query that is not in `uncertain` gets the answer of Certified::first_hit, to the bit of the time.
///  2. Any number of threads may use one engine.
///  3. On a graphics card the results are the same, to the bit.
///
/// Units: as in QueryColumns. Cost: that of Batch with rounded times. Fewer than one in 10 000 drawn queries
/// are `uncertain`; in a scene that Reduction does not support, all are.
class CertifiedBatch {
 public:
  /// Throws InputError if the scene is invalid (flaw_of) or has dependent vectors (dependence_in).
  explicit CertifiedBatch(const Scene& scene);
  ~CertifiedBatch();
  CertifiedBatch(CertifiedBatch&&) noexcept;
  CertifiedBatch& operator=(CertifiedBatch&&) noexcept;

  /// Flies on graphics card `number`, modulo how many there are; the threads fly what it leaves. Throws
  /// InputError, besides, if there is no card or driver, the build has no kernels, or they do not do the scene
  /// (docs/gpu.md), and std::runtime_error if the card's results have other bits than the processor's.
  CertifiedBatch(const Scene& scene, unsigned number);

  /// Answers the queries on `jobs` threads. The columns must include `outcome`, `time` and `time_is_rounded`;
  /// throws InputError for invalid columns. A query has the outcome `later` if nothing is entered before its
  /// limit. `uncertain` receives, in order, the indices of the queries for which the oracle must be asked
  /// (Certified::first_hit); their outcome is `undecided`, and their other columns hold no answer.
  void first_hits(const QueryColumns& queries, const FlightColumns& flights,
                  std::vector<std::size_t>& uncertain, int jobs = 1) const;

  /// For an engine on a card, and columns in the card's memory (any but `stage` and `time_is_rounded`):
  /// answers all queries, if need be by the oracle. The lattice is -1 without an obstacle. Row i of x is at x[k][i *
  /// steps[0]], of v at v[k][i * steps[1]]. Returns which rows are errors, and why: invalid queries, and
  /// obstacles in cells that 64 bits do not hold.
  std::vector<std::pair<std::size_t, std::string>> first_hits_there(const QueryColumns& queries,
                                                                    const std::array<std::size_t, 2>& steps,
                                                                    const FlightColumns& flights) const;

  const Certified& one_at_a_time() const { return certified_; }

 private:
  Certified certified_;
  int dimension_;
  std::optional<Batch> batch_;  ///< empty if the scene is beyond the fast engine
  std::unique_ptr<const gpu::GpuBatch> card_;
};

}  // namespace lorentz::oracle
