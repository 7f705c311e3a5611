#include "question/many_flights.hpp"

#include <numeric>

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

// ---- any engine

ColumnFlyer::ColumnFlyer(const EngineInfo& engine, const Scene& scene)
    : dimension_(scene.dimension), single_(engine.first_hit(scene)) {
  const bool certified = engine.traits.is_exact;
  if (engine.traits.uses_reduction && (certified || !Reduction::beyond(scene)))
    together_.emplace(certified, scene);
}

void ColumnFlyer::fly(const QueryColumns& queries, FlightTable& flights) const {
  flights.resize(queries.size());
  const FlightColumns columns = flights.columns();
  std::vector<std::size_t> rest;
  if (together_) {
    together_->fly(queries, columns, rest);
  } else {
    rest.resize(queries.size());
    std::iota(rest.begin(), rest.end(), 0);
  }
  Answer answer;
  for (const std::size_t i : rest) {
    single_(queries.query(i, dimension_), {}, answer);
    columns.outcome[i] = answer.outcome;
    columns.time[i] = answer.time.value_or(0);
  }
}

}  // namespace lorentz::question
