// A batch engine that is asked in two ways at once.
#include <memory>

#include "question/scene_engine.hpp"

namespace lorentz::question {
namespace {

Flight fly_alone(const Batch& batch, const Query& query, double max_time, Batch::Time time) {
  return batch.one_at_a_time().fly(query, max_time, time);
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
    const bool fits_columns = QueryTable().push_back(query);
    reply.answer = fits_columns ? Answer::error("a single flight has another answer") : answer_of(flight);
  };
  const auto fly = [batch, alone, dimension = scene.dimension](const QueryColumns& queries,
                                                               const FlightColumns& flights,
                                                               std::vector<std::size_t>& rest, int jobs) {
    rest.clear();
    FlightTable close, rounded;
    close.resize(queries.size()), rounded.resize(queries.size());
    batch->fly(queries, close.columns(), Batch::Time::close, jobs);
    batch->fly(queries, rounded.columns(), Batch::Time::rounded, jobs);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Query query = queries.query(i, dimension);
      const double limit = queries.max_time.empty() ? kForEver : queries.max_time[i];
      flights.set(i, close[i]);
      if (close[i] != alone(*batch, query, limit, Batch::Time::close) ||
          rounded[i] != alone(*batch, query, limit, Batch::Time::rounded))
        rest.push_back(i);
    }
  };
  return {scene, traits, ask, fly};
}

}  // namespace lorentz::question
