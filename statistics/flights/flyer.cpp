#include "statistics/flights/flyer.hpp"

#include <fmt/format.h>

#include <lorentz/errors.hpp>

namespace lorentz::flights {
namespace {

// The number of flights that are drawn and flown together: small enough that their columns stay in the cache.
constexpr std::uint64_t kTogether = 4096;

}  // namespace

Flyer::Flyer(const FlightsPlan& plan, const question::ColumnFlyer& engine)
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

// Counts a flight. Returns false if the start lies in an obstacle.
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
