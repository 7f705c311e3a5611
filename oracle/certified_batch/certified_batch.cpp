#include <lorentz/certified_batch.hpp>

#include <algorithm>

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
  if (batch_)
    batch_->fly(queries, flights, Batch::Time::rounded, jobs);
  else
    std::ranges::fill(flights.outcome.first(queries.size()), Outcome::undecided);
  uncertain.clear();
  for (std::size_t i = 0; i < queries.size(); ++i) {
    Outcome& outcome = flights.outcome[i];
    if (outcome == Outcome::hit && !flights.time_is_rounded[i]) outcome = Outcome::undecided;
    if (outcome == Outcome::undecided) uncertain.push_back(i);
  }
}

}  // namespace lorentz::oracle
