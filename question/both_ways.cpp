// A batch engine that is asked in two ways at once.
#include <cstring>
#include <memory>

#include "question/scene_engine.hpp"

namespace lorentz::question {
namespace {

Flight fly_alone(const Batch& batch, const Query& query, double max_time, Batch::Time time) {
  return batch.one_at_a_time().fly(query, max_time, time);
}

bool same_bits(const Flight& a, const Flight& b) {
  return a.outcome == b.outcome && a.stage == b.stage && a.time_is_rounded == b.time_is_rounded &&
         a.lattice == b.lattice && a.atom == b.atom && a.cell == b.cell &&
         std::memcmp(&a.time, &b.time, sizeof a.time) == 0;
}

Flight flight_in(const FlightColumns& columns, std::size_t i) {
  Flight flight{.outcome = columns.outcome[i],
                .stage = columns.stage[i],
                .time_is_rounded = columns.time_is_rounded[i],
                .lattice = columns.lattice[i],
                .atom = columns.atom[i]};
  for (int k = 0; k < 3; ++k) flight.cell[k] = columns.cell[k][i];
  flight.time = columns.time[i];
  return flight;
}

bool fits_columns(const Query& query) {
  return QueryTable().push_back(query);
}

}  // namespace

SceneEngine batch_both_ways(const Scene& scene, const Traits& traits, FlyAlone alone) {
  if (const auto why_not = Reduction::beyond(scene)) return SceneEngine::unsupported(scene, traits, *why_not);
  if (!alone) alone = fly_alone;
  const auto batch = std::make_shared<const Batch>(scene);
  // Queries are valid. So one that is asked alone was flown and had two answers, unless it fits no columns.
  const auto ask = [batch](const Query& query, const oracle::Request& request, Reply& reply) {
    const Flight flight = batch->one_at_a_time().fly(query, limit_of(request));
    reply.stage = flight.stage;
    reply.answer =
        fits_columns(query) ? Answer::error("a single flight has another answer") : answer_of(flight);
  };
  const auto fly = [batch, alone, dimension = scene.dimension](const QueryColumns& queries,
                                                               const FlightColumns& flights,
                                                               std::vector<std::size_t>& rest, int jobs) {
    rest.clear();
    batch->fly(queries, flights, Batch::Time::close, jobs);
    FlightTable rounded;
    rounded.resize(queries.size());
    batch->fly(queries, rounded.columns(), Batch::Time::rounded, jobs);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Query query = queries.query(i, dimension);
      const double limit = queries.max_time.empty() ? kForEver : queries.max_time[i];
      if (!same_bits(flight_in(flights, i), alone(*batch, query, limit, Batch::Time::close)) ||
          !same_bits(rounded[i], alone(*batch, query, limit, Batch::Time::rounded)))
        rest.push_back(i);
    }
  };
  return {scene, traits, ask, fly};
}

}  // namespace lorentz::question
