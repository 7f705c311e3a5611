#include "compare/batch_answerer.hpp"

#include <limits>

#include "compare/engines.hpp"

namespace lorentz::compare {
namespace {

// So many that threads have something to share, and so few that answers come soon.
constexpr std::size_t kGathered = 8192;

}  // namespace

BatchAnswerer::BatchAnswerer(bool certified, const AnswererOptions& options)
    : certified_(certified), request_(options.request), jobs_(options.jobs) {}

void BatchAnswerer::set_scene(const Scene& scene) {
  drain();
  scene_ = scene;
  batch_.reset(), certified_batch_.reset(), why_not_.reset();
  if (certified_) {
    certified_batch_.emplace(scene);
    return;
  }
  why_not_ = Reduction::beyond(scene);
  if (!why_not_) batch_.emplace(scene);
}

void BatchAnswerer::ask(const Id&, const Query& query) {
  const double limit = request_.max_time.value_or(std::numeric_limits<double>::infinity());
  if (!queries_.push_back(query, limit)) {  // `from` is too far away for the columns
    drain();
    Answer answer = single(query);
    deliver(answer);
  } else if (queries_.size() == kGathered) {
    drain();
  }
}

void BatchAnswerer::ask_text(const Id& id, const std::string& text) {
  drain();
  Answerer::ask_text(id, text);
}

bool BatchAnswerer::idle(int) {
  drain();
  return false;
}

void BatchAnswerer::drain() {
  if (queries_.size() == 0) return;
  fly();
  answer_all();
  queries_.clear();
}

void BatchAnswerer::fly() {
  flights_.resize(queries_.size());
  uncertain_.clear();
  if (batch_) batch_->fly(queries_.columns(), flights_.columns(), Batch::Time::close, jobs_);
  if (certified_batch_)
    certified_batch_->first_hits(queries_.columns(), flights_.columns(), uncertain_, jobs_);
}

void BatchAnswerer::answer_all() {
  std::size_t next = 0;
  for (std::size_t i = 0; i < queries_.size(); ++i) {
    const bool uncertain = next < uncertain_.size() && uncertain_[next] == i;
    next += uncertain;
    Answer answer = uncertain ? single(queries_[i]) : answer_of_flight(i);
    deliver(answer);
  }
}

Answer BatchAnswerer::answer_of_flight(std::size_t i) {
  const Flight flight = why_not_ ? Flight{} : flights_[i];
  if (why_not_ || flight.outcome == Outcome::error || request_.detail || request_.digits > 0)
    return single(queries_[i]);
  return answer_of(flight);
}

// Queries with a flaw, and what more is wanted than a flight says.
Answer BatchAnswerer::single(const Query& query) const {
  if (why_not_) return Answer::unsupported_because("batch " + *why_not_);
  Answer answer;
  if (certified_batch_) {
    certified_batch_->one_at_a_time().first_hit(query, request_, answer);
    return answer;
  }
  const double limit = request_.max_time.value_or(std::numeric_limits<double>::infinity());
  batch_->one_at_a_time().first_hit(query, limit, answer);
  if (request_.detail) add_detail(query, scene_, answer);
  return answer;
}

}  // namespace lorentz::compare
