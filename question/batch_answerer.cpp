#include "question/batch_answerer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "question/engines.hpp"

namespace lorentz::question {
namespace {

// Enough that threads have something to share, and few enough that answers come soon.
constexpr std::size_t kGathered = 8192;

constexpr double kForEver = std::numeric_limits<double>::infinity();

}  // namespace

BatchAnswerer::BatchAnswerer(bool certified, const AnswererOptions& options)
    : certified_(certified), request_(options.request), jobs_(options.jobs) {}

void BatchAnswerer::enter(const Scene& scene) {
  drain();
  engine_.reset();
  why_not_ = certified_ ? std::nullopt : Reduction::beyond(scene);
  if (!why_not_) engine_.emplace(certified_, scene);
}

void BatchAnswerer::ask(const Id& id, const Query& query) {
  ask_until(id, query, kForEver);
}

void BatchAnswerer::ask_until(const Id&, const Query& query, double max_time) {
  const double limit = std::min(max_time, request_.max_time.value_or(kForEver));
  if (!queries_.push_back(query, limit)) {  // `from` is too far away for the columns
    drain();
    Reply reply = single(query, limit);
    if (batch()) reply.stage = batch()->one_at_a_time().fly(query, limit).stage;
    deliver(reply);
  } else if (queries_.size() == kGathered) {
    drain();
  }
}

void BatchAnswerer::drain() {
  if (queries_.size() == 0) return;
  flights_.resize(queries_.size());
  fly();
  std::size_t next = 0;
  for (std::size_t i = 0; i < queries_.size(); ++i) {
    const bool uncertain = next < uncertain_.size() && uncertain_[next] == i;
    next += uncertain;
    deliver(uncertain ? single(queries_[i], limit(i)) : reply_to(i));
  }
  queries_.clear();
}

void BatchAnswerer::fly() {
  if (engine_) engine_->fly(queries_.columns(), flights_.columns(), uncertain_, jobs_);
}

double BatchAnswerer::limit(std::size_t i) const {
  const std::span<const double> limits = queries_.columns().max_time;
  return limits.empty() ? kForEver : limits[i];
}

Reply BatchAnswerer::reply_to(std::size_t i) const {
  const Flight flight = why_not_ ? Flight{} : flights_[i];
  if (why_not_ || flight.outcome == Outcome::error || request_.detail || request_.digits > 0)
    return single(queries_[i], limit(i));
  return {.answer = answer_of(flight), .stage = flight.stage};
}

// Answers an invalid or uncertain query, or a request that needs more than a flight contains.
Reply BatchAnswerer::single(const Query& query, double max_time) const {
  if (why_not_) return {Answer::unsupported_because("batch " + *why_not_)};
  Reply reply;
  if (const auto* certified = engine_->certified()) {
    oracle::Request request = request_;
    if (std::isfinite(max_time)) request.max_time = max_time;
    certified->one_at_a_time().first_hit(query, request, reply.answer);
    reply.stage = Stage::undecided;
    return reply;
  }
  batch()->one_at_a_time().first_hit(query, max_time, reply.answer);
  if (request_.detail) add_detail(query, scene(), reply.answer);
  return reply;
}

}  // namespace lorentz::question
