// Many flights at once: by the engines that fly them together, and by any engine.
#pragma once

#include <optional>
#include <vector>

#include <lorentz/certified_batch.hpp>
#include "question/engines.hpp"

namespace lorentz::question {

/// `batch` or `certified-batch` in one scene. Any number of threads may share it.
class ManyFlights {
 public:
  /// `batch` needs a scene that Reduction supports (Reduction::beyond).
  ManyFlights(bool certified, const Scene& scene);

  /// `uncertain` gets the queries that must still be asked one by one, in order; empty for `batch`.
  void fly(const QueryColumns& queries, const FlightColumns& flights, std::vector<std::size_t>& uncertain,
           int jobs = 1) const;

  /// One of the two is null.
  const Batch* batch() const { return batch_ ? &*batch_ : nullptr; }
  const oracle::CertifiedBatch* certified() const { return certified_ ? &*certified_ : nullptr; }

 private:
  std::optional<Batch> batch_;
  std::optional<oracle::CertifiedBatch> certified_;
};

/// An engine of this program, asked by columns: those that rest on `reduction` together, the others row by
/// row. Any number of threads may share it if they may share the engine.
class ColumnFlyer {
 public:
  ColumnFlyer(const EngineInfo& engine, const Scene& scene);

  /// Gives outcomes and times. Queries that stay uncertain together are asked one by one.
  void fly(const QueryColumns& queries, FlightTable& flights) const;

 private:
  int dimension_;
  std::optional<ManyFlights> together_;
  FirstHit single_;
};

}  // namespace lorentz::question
