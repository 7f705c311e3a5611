#include "question/column_engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lorentz::question {
namespace {

constexpr double kNoTimeLimit = std::numeric_limits<double>::infinity();

// The one stage with which an engine of this kind decides; unknown for the others.
std::uint8_t usual_stage(const Traits& traits) {
  return traits.is_exact && !traits.uses_reduction ? AnswerRows::kExactStage : AnswerRows::kNoStage;
}

}  // namespace

ColumnEngine::ColumnEngine(const EngineInfo& engine, const Scene& scene, std::optional<double> max_time,
                           int jobs)
    : scene_(scene),
      traits_(engine.traits),
      max_time_(max_time),
      jobs_(jobs),
      single_(engine.first_hit(scene)) {
  if (traits_.in_bulk && !Reduction::beyond(scene)) together_.emplace(traits_.is_exact, scene);
}

void ColumnEngine::set_limits(const QueryRows& queries) {
  limits_ = queries.max_time;
  if (!max_time_) return;
  limits_.resize(queries.count, kNoTimeLimit);
  for (double& limit : limits_) limit = limit > *max_time_ ? *max_time_ : limit;
}

double ColumnEngine::limit(std::size_t i) const {
  return limits_.empty() ? kNoTimeLimit : limits_[i];
}

void ColumnEngine::fly(std::size_t first, const QueryRows& queries, AnswerRows& answers) {
  const std::size_t count = queries.count;
  QueryColumns asked;
  FlightColumns told;
  stages_.resize(std::max(stages_.size(), count));
  told.outcome = std::span(answers.outcome).subspan(first, count);
  told.stage = std::span(stages_).first(count);
  told.time_is_rounded = {answers.time_is_rounded.get() + first, count};
  told.lattice = std::span(answers.lattice).subspan(first, count);
  told.atom = std::span(answers.atom).subspan(first, count);
  told.time = std::span(answers.time).subspan(first, count);
  for (int k = 0; k < scene_.dimension; ++k) {
    asked.x[k] = std::span(queries.x[k]).first(count), asked.v[k] = std::span(queries.v[k]).first(count);
    if (!queries.from_lattice.empty()) asked.from_cell[k] = std::span(queries.from_cell[k]).first(count);
    told.cell[k] = {answers.cell[k] + first, count};
  }
  if (!limits_.empty()) asked.max_time = std::span(limits_).first(count);
  if (!queries.from_lattice.empty()) {
    asked.from_lattice = std::span(queries.from_lattice).first(count);
    asked.from_atom = std::span(queries.from_atom).first(count);
  }
  together_->fly(asked, told, uncertain_, jobs_);
  std::transform(stages_.begin(), stages_.begin() + static_cast<std::ptrdiff_t>(queries.count),
                 answers.stage.begin() + static_cast<std::ptrdiff_t>(first),
                 [](Stage stage) { return static_cast<std::uint8_t>(stage); });
}

// Sets what a flight leaves open: the columns that have no meaning for its outcome.
void ColumnEngine::finish(std::size_t first, const QueryRows& queries, std::size_t i, AnswerRows& answers) {
  const std::size_t row = first + i;
  const Outcome outcome = answers.outcome[row];
  if (outcome == Outcome::hit) return;
  if (outcome == Outcome::error) return ask(first, queries, i, AnswerRows::kNoStage, answers);
  if (outcome != Outcome::inside) return answers.set_plain(row, outcome);
  answers.time[row] = std::numeric_limits<double>::quiet_NaN(), answers.time_is_rounded[row] = false;
}

void ColumnEngine::ask(std::size_t first, const QueryRows& queries, std::size_t i, std::uint8_t stage,
                       AnswerRows& answers) {
  oracle::Request request;
  if (std::isfinite(limit(i))) request.max_time = limit(i);
  single_(queries.query(i, scene_.dimension), request, answer_);
  answers.set(first + i, answer_, stage, traits_.is_exact);
}

void ColumnEngine::answer(const QueryRows& queries, AnswerRows& answers) {
  answers.resize(queries.count, scene_.dimension);
  answer_from(0, queries, answers);
}

void ColumnEngine::answer_from(std::size_t first, const QueryRows& queries, AnswerRows& answers) {
  set_limits(queries);
  uncertain_.clear();
  if (together_) fly(first, queries, answers);
  // For nearly all rows the flight has written everything already.
  const bool is_plain = together_ && limits_.empty() && uncertain_.empty() && queries.flaws.empty() &&
                        queries.large_from.empty();
  std::size_t uncertain = 0, flaw = 0, large = 0;
  for (std::size_t i = 0; i < queries.count; ++i) {
    if (is_plain && answers.outcome[first + i] == Outcome::hit) continue;
    const bool asked = uncertain < uncertain_.size() && uncertain_[uncertain] == i;
    uncertain += asked;
    const bool from_afar = large < queries.large_from.size() && queries.large_from[large].first == i;
    large += from_afar;
    if (flaw < queries.flaws.size() && queries.flaws[flaw].row == i)
      answers.set_error(first + i, queries.flaws[flaw++].message, false);
    else if (!(limit(i) > 0))
      answers.set_error(first + i, "max_time must be above zero", false);
    else if (asked)
      ask(first, queries, i, AnswerRows::kExactStage, answers);
    else if (together_ && !from_afar)
      finish(first, queries, i, answers);
    else
      ask(first, queries, i, usual_stage(traits_), answers);
  }
}

}  // namespace lorentz::question
