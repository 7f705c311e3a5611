#include "question/many_flights.hpp"

namespace lorentz::question {

ManyFlights::ManyFlights(bool certified, const Scene& scene) {
  if (certified)
    certified_.emplace(scene);
  else
    batch_.emplace(scene);
}

void ManyFlights::fly(const QueryColumns& queries, const FlightColumns& flights,
                      std::vector<std::size_t>& uncertain, int jobs) const {
  uncertain.clear();
  if (certified_)
    certified_->first_hits(queries, flights, uncertain, jobs);
  else
    batch_->fly(queries, flights, Batch::Time::close, jobs);
}

}  // namespace lorentz::question
