#include <lorentz/certified_batch.hpp>

namespace lorentz::oracle {

CertifiedBatch::CertifiedBatch(const Scene& scene) : certified_(scene) {
  if (!Reduction::beyond(scene)) batch_.emplace(scene);
}

void CertifiedBatch::first_hits(const QueryColumns& queries, const FlightColumns& flights,
                                std::vector<std::size_t>& uncertain, int jobs) const {
  uncertain.clear();
  if (!batch_) {
    for (std::size_t i = 0; i < queries.count; ++i) uncertain.push_back(i);
    return;
  }
  batch_->fly(queries, flights, Batch::Time::rounded, jobs);
  for (std::size_t i = 0; i < queries.count; ++i) {
    const Outcome outcome = flights.outcome[i];
    if (outcome == Outcome::undecided || (outcome == Outcome::hit && !flights.time_is_rounded[i]))
      uncertain.push_back(i);
  }
}

}  // namespace lorentz::oracle
