// The engines that fly many at once, `batch` and `certified-batch`, asked alike.
#pragma once

#include <optional>
#include <vector>

#include <lorentz/certified_batch.hpp>

namespace lorentz::question {

/// One of the two for one scene. Any number of threads may share it.
class ManyFlights {
 public:
  /// `batch` needs a scene that Reduction does (Reduction::beyond).
  ManyFlights(bool certified, const Scene& scene);

  /// `uncertain`: the queries that are still to be asked one by one, in order; empty of `batch`.
  void fly(const QueryColumns& queries, const FlightColumns& flights, std::vector<std::size_t>& uncertain,
           int jobs = 1) const;

  /// One of the two is null.
  const Batch* batch() const { return batch_ ? &*batch_ : nullptr; }
  const oracle::CertifiedBatch* certified() const { return certified_ ? &*certified_ : nullptr; }

 private:
  std::optional<Batch> batch_;
  std::optional<oracle::CertifiedBatch> certified_;
};

}  // namespace lorentz::question
