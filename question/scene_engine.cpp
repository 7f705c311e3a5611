#include "question/scene_engine.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lorentz::question {

SceneEngine SceneEngine::unsupported(const Scene& scene, const Traits& traits, const std::string& why) {
  return {scene, traits, [why](const Query&, const oracle::Request&, Reply& reply) {
            reply = {Answer::unsupported_because(why)};
          }};
}

QueryColumns view_of(const QueryRows& rows) {
  const auto used = [&](const auto& column) {
    return std::span(column).first(std::min(column.size(), rows.count));
  };
  QueryColumns columns;
  for (int k = 0; k < 3; ++k)
    columns.x[k] = used(rows.x[k]), columns.v[k] = used(rows.v[k]),
    columns.from_cell[k] = used(rows.from_cell[k]);
  columns.max_time = used(rows.max_time);
  columns.from_lattice = used(rows.from_lattice), columns.from_atom = used(rows.from_atom);
  return columns;
}

void SceneEngine::fly(const QueryColumns& queries, FlightTable& flights) const {
  flights.resize(queries.size());
  const FlightColumns columns = flights.columns();
  std::vector<std::size_t> rest;
  if (flies_together()) {
    fly_together(queries, columns, rest, 1);
  } else {
    rest.resize(queries.size());
    std::iota(rest.begin(), rest.end(), 0);
  }
  Reply reply;
  for (const std::size_t i : rest) {
    const double limit = queries.max_time.empty() ? kForEver : queries.max_time[i];
    ask(queries.query(i, dimension_), {.max_time = limit}, reply);
    columns.outcome[i] = reply.answer.outcome;
    columns.time[i] = reply.answer.time.value_or(0);
  }
}

namespace {

// Some rows, and the answers to them.
class RowsAnswered {
 public:
  RowsAnswered(const SceneEngine& engine, const QueryRows& queries, AnswerRows& answers, std::size_t first,
               double max_time)
      : engine_(engine), queries_(queries), answers_(answers), first_(first), limits_(queries.max_time) {
    if (std::isinf(max_time)) return;
    limits_.resize(queries.count, kForEver);
    for (double& limit : limits_) limit = std::min(limit, max_time);
  }

  void answer(int jobs) {
    const bool together = engine_.traits().together > 0 && engine_.flies_together();
    if (together) fly(jobs);
    // For nearly all rows the flight has written everything already.
    const bool is_plain = together && limits_.empty() && uncertain_.empty() && queries_.flaws.empty() &&
                          queries_.large_from.empty();
    std::size_t uncertain = 0, flaw = 0, large = 0;
    for (std::size_t i = 0; i < queries_.count; ++i) {
      if (is_plain && answers_.outcome[first_ + i] == Outcome::hit) continue;
      const bool asked = uncertain < uncertain_.size() && uncertain_[uncertain] == i;
      uncertain += asked;
      const bool from_afar = large < queries_.large_from.size() && queries_.large_from[large].first == i;
      large += from_afar;
      if (flaw < queries_.flaws.size() && queries_.flaws[flaw].row == i)
        answers_.set_error(first_ + i, queries_.flaws[flaw++].message, false);
      else if (!(limit(i) > 0))
        answers_.set_error(first_ + i, "max_time must be above zero", false);
      else if (asked)
        ask(i, AnswerRows::kExactStage);
      else if (together && !from_afar)
        finish(i);
      else
        ask(i, usual_stage());
    }
  }

 private:
  double limit(std::size_t i) const { return limits_.empty() ? kForEver : limits_[i]; }

  // The one stage with which an engine of this kind decides; unknown for the others.
  std::uint8_t usual_stage() const {
    const Traits& traits = engine_.traits();
    return traits.is_exact && !traits.uses_reduction ? AnswerRows::kExactStage : AnswerRows::kNoStage;
  }

  void fly(int jobs) {
    const std::size_t count = queries_.count;
    std::vector<Stage> stages(count);
    QueryColumns asked = view_of(queries_);
    if (!limits_.empty()) asked.max_time = std::span(limits_).first(count);
    FlightColumns told;
    told.outcome = std::span(answers_.outcome).subspan(first_, count);
    told.stage = stages;
    told.time_is_rounded = {answers_.time_is_rounded.get() + first_, count};
    told.lattice = std::span(answers_.lattice).subspan(first_, count);
    told.atom = std::span(answers_.atom).subspan(first_, count);
    told.time = std::span(answers_.time).subspan(first_, count);
    for (int k = 0; k < answers_.dimension; ++k) told.cell[k] = {answers_.cell(k) + first_, count};
    engine_.fly_together(asked, told, uncertain_, jobs);
    std::ranges::transform(stages, answers_.stage.begin() + static_cast<std::ptrdiff_t>(first_),
                           [](Stage stage) { return static_cast<std::uint8_t>(stage); });
  }

  // Sets what a flight leaves open: the columns that have no meaning for its outcome.
  void finish(std::size_t i) {
    const std::size_t row = first_ + i;
    const Outcome outcome = answers_.outcome[row];
    if (outcome == Outcome::hit) return;
    if (outcome == Outcome::error) return ask(i, AnswerRows::kNoStage);
    if (outcome != Outcome::inside) return answers_.set_plain(row, outcome);
    answers_.time[row] = std::numeric_limits<double>::quiet_NaN(), answers_.time_is_rounded[row] = false;
  }

  void ask(std::size_t i, std::uint8_t stage) {
    engine_.ask(queries_.query(i, answers_.dimension), {.max_time = limit(i)}, reply_);
    answers_.set(first_ + i, reply_.answer, stage, engine_.traits().is_exact);
  }

  const SceneEngine& engine_;
  const QueryRows& queries_;
  AnswerRows& answers_;
  const std::size_t first_;
  std::vector<double> limits_;  // empty: no row has one
  std::vector<std::size_t> uncertain_;
  Reply reply_;
};

}  // namespace

void SceneEngine::answer(const QueryRows& queries, AnswerRows& answers, std::size_t first, double max_time,
                         int jobs) const {
  RowsAnswered(*this, queries, answers, first, max_time).answer(jobs);
}

SceneEngine batch_both_ways(const Scene& scene, const Traits& traits, FlyAlone alone) {
  if (const auto why_not = Reduction::beyond(scene)) return SceneEngine::unsupported(scene, traits, *why_not);
  if (!alone)
    alone = [](const Batch& batch, const Query& query, double max_time, Batch::Time time) {
      return batch.one_at_a_time().fly(query, max_time, time);
    };
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
