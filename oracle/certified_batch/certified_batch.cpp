#include <lorentz/certified_batch.hpp>

#include <algorithm>

#include <lorentz/errors.hpp>
#include "src/engines/gpu/gpu_batch.hpp"

namespace lorentz::oracle {

CertifiedBatch::CertifiedBatch(const Scene& scene) : certified_(scene), dimension_(scene.dimension) {
  if (!Reduction::beyond(scene)) batch_.emplace(scene);
}

CertifiedBatch::CertifiedBatch(const Scene& scene, unsigned number) : CertifiedBatch(scene) {
  if (const auto why = Reduction::beyond(scene)) throw InputError("gpu " + *why);
  card_ = std::make_unique<const gpu::GpuBatch>(scene, *batch_, number);
}

CertifiedBatch::~CertifiedBatch() = default;
CertifiedBatch::CertifiedBatch(CertifiedBatch&&) noexcept = default;
CertifiedBatch& CertifiedBatch::operator=(CertifiedBatch&&) noexcept = default;

namespace {

// Flies the rows that a card leaves.
void fly_left(const Batch& batch, int dimension, const std::vector<std::size_t>& left,
              const QueryColumns& queries, const FlightColumns& flights, int jobs) {
  QueryTable asked;
  for (const std::size_t i : left)
    asked.push_back(queries.query(i, dimension), queries.max_time.empty() ? HUGE_VAL : queries.max_time[i]);
  FlightTable told;
  told.resize(left.size());
  batch.fly(asked.columns(), told.columns(), Batch::Time::rounded, jobs);
  for (std::size_t i = 0; i < left.size(); ++i) flights.set(left[i], told[i]);
}

}  // namespace

void CertifiedBatch::first_hits(const QueryColumns& queries, const FlightColumns& flights,
                                std::vector<std::size_t>& uncertain, int jobs) const {
  if (const auto flaw = flaw_of(queries, flights, dimension_)) throw InputError(*flaw);
  if (queries.size() > 0 && (flights.time.empty() || flights.time_is_rounded.empty()))
    throw InputError("the columns time and time_is_rounded are needed");
  if (card_)
    fly_left(*batch_, dimension_, card_->fly(queries, flights), queries, flights, jobs);
  else if (batch_)
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

std::vector<std::pair<std::size_t, std::string>> CertifiedBatch::first_hits_there(
    const QueryColumns& queries, const std::array<std::size_t, 2>& steps,
    const FlightColumns& flights) const {
  std::vector<std::pair<std::size_t, std::string>> errors;
  Answer answer;
  for (const std::size_t i : card_->fly_there(queries, steps, flights)) {
    const auto [query, max_time] = card_->query_there(queries, steps, i);
    Request request;
    if (max_time != HUGE_VAL) request.max_time = max_time;
    if (max_time > 0)
      certified_.first_hit(query, request, answer);
    else
      answer = Answer::error("max_time must be above zero");
    Flight flight;
    flight.outcome = answer.outcome, flight.time = answer.time.value_or(0);
    const bool is_named = flight.outcome == Outcome::hit || flight.outcome == Outcome::inside;
    flight.lattice = is_named ? answer.obstacle.lattice : -1, flight.atom = answer.obstacle.atom;
    if (std::ranges::all_of(answer.obstacle.cell, &Integer::fits_int64))
      std::ranges::transform(answer.obstacle.cell, flight.cell.begin(), &Integer::int64);
    else
      answer.message = "the obstacle's cell is beyond 64 bits", flight.outcome = Outcome::error;
    if (flight.outcome == Outcome::error) errors.emplace_back(i, answer.message);
    card_->set_there(flights, i, flight);
  }
  return errors;
}

}  // namespace lorentz::oracle
