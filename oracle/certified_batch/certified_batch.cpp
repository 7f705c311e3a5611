#include <lorentz/certified_batch.hpp>

#include <cmath>

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
    Outcome& outcome = flights.outcome[i];
    const double limit = queries.max_time ? queries.max_time[i] : HUGE_VAL;
    const bool hit = outcome == Outcome::hit;
    // Of a time that is rounded to the limit itself one does not know on which side it is.
    if (outcome == Outcome::undecided || (hit && (!flights.time_is_rounded[i] || flights.time[i] == limit)))
      uncertain.push_back(i);
    else if (limit != HUGE_VAL && (outcome == Outcome::never || (hit && flights.time[i] > limit)))
      outcome = Outcome::later;
  }
}

}  // namespace lorentz::oracle
