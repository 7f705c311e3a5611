#include <lorentz/certified_batch.hpp>

#include <lorentz/errors.hpp>

namespace lorentz::oracle {

CertifiedBatch::CertifiedBatch(const Scene& scene) : certified_(scene), dimension_(scene.dimension) {
  if (!Reduction::beyond(scene)) batch_.emplace(scene);
}

void CertifiedBatch::first_hits(const QueryColumns& queries, const FlightColumns& flights,
                                std::vector<std::size_t>& uncertain, int jobs) const {
  if (const auto flaw = flaw_of(queries, flights, dimension_)) throw InputError(*flaw);
  if (queries.size() > 0 && (flights.time.empty() || flights.time_is_rounded.empty()))
    throw InputError("the columns time and time_is_rounded are needed");
  uncertain.clear();
  if (!batch_) {
    for (std::size_t i = 0; i < queries.size(); ++i) uncertain.push_back(i);
    return;
  }
  batch_->fly(queries, flights, Batch::Time::rounded, jobs);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Outcome outcome = flights.outcome[i];
    if (outcome == Outcome::undecided || (outcome == Outcome::hit && !flights.time_is_rounded[i]))
      uncertain.push_back(i);
  }
}

}  // namespace lorentz::oracle
