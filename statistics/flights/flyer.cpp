#include "statistics/flights/flyer.hpp"

#include <fmt/format.h>

#include <lorentz/errors.hpp>

namespace lorentz::flights {
namespace {

// So many flights are drawn and flown together that their columns stay in the cache.
constexpr std::uint64_t kTogether = 4096;

}  // namespace

// ---- engines by columns

ColumnFlyer::ColumnFlyer(const question::EngineInfo& engine, const Scene& scene)
    : single_(engine.first_hit(scene)) {
  if (!engine.traits.uses_reduction) return;  // asked one at a time
  if (engine.traits.is_exact) {
    certified_.emplace(scene);
    return;
  }
  if (const auto why = Reduction::beyond(scene))
    throw InputError(fmt::format("the engine {} {}; certified does such scenes", engine.name, *why));
  batch_.emplace(scene);
}

namespace {

Query query_at(const QueryColumns& queries, std::size_t i) {
  Query query;
  for (std::size_t k = 0; k < 3; ++k) {
    if (queries.x[k]) query.x[k] = queries.x[k][i];
    if (queries.v[k]) query.v[k] = queries.v[k][i];
  }
  if (!queries.from_lattice || queries.from_lattice[i] < 0) return query;
  query.from.emplace();
  query.from->lattice = queries.from_lattice[i], query.from->atom = queries.from_atom[i];
  for (std::size_t k = 0; k < 3; ++k)
    if (queries.from_cell[k]) query.from->cell[k] = Integer(queries.from_cell[k][i]);
  return query;
}

// Of an answer only what is counted.
void set(const Answer& answer, std::size_t i, const FlightColumns& flights) {
  flights.outcome[i] = answer.outcome;
  flights.time[i] = answer.time.value_or(0);
}

}  // namespace

void ColumnFlyer::fly(const QueryColumns& queries, FlightTable& flights) const {
  flights.resize(queries.count);
  FlightColumns columns = flights.columns();
  if (batch_) {
    batch_->fly(queries, columns);
    return;
  }
  std::vector<std::size_t> uncertain(certified_ ? 0 : queries.count);
  if (certified_)
    certified_->first_hits(queries, columns, uncertain);
  else
    for (std::size_t i = 0; i < uncertain.size(); ++i) uncertain[i] = i;
  Answer answer;
  for (const std::size_t i : uncertain) {
    single_(query_at(queries, i), {}, answer);
    set(answer, i, columns);
  }
}

// ---- a thread's flights

Flyer::Flyer(const FlightsPlan& plan, const ColumnFlyer& engine)
    : engine_(engine), starts_(plan.scene, plan.from, plan.seed, plan.cells) {}

void Flyer::fly(std::uint64_t first, std::uint64_t count, FlightTally& tally) {
  for (std::uint64_t done = 0; done < count; done += kTogether) {
    const std::uint64_t together = std::min(kTogether, count - done);
    starts_.draw(first + done, together, columns_);
    engine_.fly(columns_.view(), flights_);
    for (std::uint64_t i = 0; i < together; ++i)
      if (!this->count(flights_[i], first + done + i, tally)) inside_.push_back(first + done + i);
    draw_anew(tally);
  }
}

// False: the start lies in an obstacle.
bool Flyer::count(const Flight& flight, std::uint64_t index, FlightTally& tally) {
  switch (flight.outcome) {
    case Outcome::hit:
      tally.count_hit(flight.time);
      inside_in_a_row_ = 0;
      return true;
    case Outcome::never:
      ++tally.never;
      return true;
    case Outcome::undecided:
      ++tally.undecided;
      return true;
    case Outcome::inside:
      ++tally.inside;
      if (++inside_in_a_row_ == starts::Candidates::kMostAttempts)
        throw InputError(starts::nowhere_to_start(inside_in_a_row_));
      return false;
    default:
      throw InputError(fmt::format("the engine has no answer to start {} in this scene", index));
  }
}

void Flyer::draw_anew(FlightTally& tally) {
  for (std::uint64_t attempt = 1; !inside_.empty(); ++attempt) {
    again_.clear();
    Query query;
    for (const std::uint64_t index : inside_) {
      starts_.draw(index, attempt, query);
      again_.push_back(query);
    }
    engine_.fly(again_.columns(), flights_);
    std::vector<std::uint64_t> still;
    for (std::size_t i = 0; i < inside_.size(); ++i)
      if (!count(flights_[i], inside_[i], tally)) still.push_back(inside_[i]);
    inside_ = std::move(still);
  }
}

}  // namespace lorentz::flights
