#include "statistics/flights/run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <future>
#include <mutex>
#include <numeric>

#include <lorentz/errors.hpp>
#include "question/engines.hpp"

namespace lorentz::flights {
namespace {

constexpr std::chrono::milliseconds kBetweenNews{200};

// The number of flights that are drawn and flown together: small enough that their columns stay in the cache.
constexpr std::uint64_t kTogether = 4096;

// Draws the starts of flights, flies them and counts the results, block by block. Each thread has its own.
class Flyer {
 public:
  Flyer(const FlightsPlan& plan, const question::SceneEngine& engine)
      : engine_(engine), starts_(plan.scene, plan.from, plan.seed, plan.cells) {}

  // Flies the starts [first, first + count) and adds the results to the tally. Throws InputError if a start
  // cannot be found, or the engine cannot answer.
  void fly(std::uint64_t first, std::uint64_t count, FlightTally& tally) {
    for (std::uint64_t done = 0; done < count; done += kTogether) {
      missing_.resize(std::min(kTogether, count - done));
      std::iota(missing_.begin(), missing_.end(), first + done);
      for (std::uint64_t attempt = 0; !missing_.empty(); ++attempt) fly_missing(attempt, tally);
    }
  }

 private:
  // Counts a flight. Returns false if the start lies in an obstacle.
  bool count(const Flight& flight, std::uint64_t index, FlightTally& tally) {
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

  void fly_missing(std::uint64_t attempt, FlightTally& tally) {
    starts_.draw(missing_, attempt, rows_);
    engine_.fly(question::view_of(rows_), flights_);
    std::size_t still = 0;
    for (std::size_t i = 0; i < missing_.size(); ++i)
      if (!count(flights_[i], missing_[i], tally)) missing_[still++] = missing_[i];
    missing_.resize(still);
  }

  const question::SceneEngine& engine_;
  const starts::Candidates starts_;
  QueryRows rows_;
  FlightTable flights_;
  std::uint64_t inside_in_a_row_ = 0;   // consecutive candidates inside
  std::vector<std::uint64_t> missing_;  // starts whose last candidate, if any, lay in an obstacle
};

question::SceneEngine engine_of(const FlightsPlan& plan) {
  const question::EngineInfo info = question::engine_named(plan.engine);
  if (const auto why = info.traits.is_exact ? std::nullopt : Reduction::beyond(plan.scene);
      why && info.traits.uses_reduction)
    throw InputError(fmt::format("the engine {} {}; certified does such scenes", info.name, *why));
  return info.in(plan.scene);
}

}  // namespace

void run(const FlightsPlan& plan, const FlightBounds& bounds, Account& account,
         const OnProgress& on_progress) {
  const question::SceneEngine engine = engine_of(plan);
  const auto begin = std::chrono::steady_clock::now();
  const std::chrono::duration<double> longest(bounds.seconds > 0 ? bounds.seconds : HUGE_VAL);
  std::mutex mutex;  // of the account and of the next two
  std::uint64_t next = bounds.shard;
  bool has_failed = false;
  const auto take = [&](std::uint64_t& block) {
    const std::lock_guard lock(mutex);
    const auto taken = std::chrono::steady_clock::now() - begin;
    if (has_failed || (bounds.stop && *bounds.stop) || taken >= longest) return false;
    while (next < plan.blocks() && (contains(account.done, next) || contains(bounds.done, next)))
      next += bounds.shards;
    if (next >= plan.blocks()) return false;
    block = next;
    next += bounds.shards;
    return true;
  };
  const auto work = [&] {
    try {
      Flyer flyer(plan, engine);
      for (std::uint64_t block; take(block);) {
        FlightTally tally(unit_exponent(plan.scene));
        flyer.fly(block * kBlock, std::min(kBlock, plan.count - block * kBlock), tally);
        const std::lock_guard lock(mutex);
        account.tally.add(tally);
        account.done += block;
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      has_failed = true;
      throw;
    }
  };
  const auto tell = [&] {
    const std::lock_guard lock(mutex);
    if (on_progress) on_progress(account);
  };
  std::vector<std::future<void>> threads;
  for (unsigned job = 0; job < bounds.jobs; ++job) threads.push_back(std::async(std::launch::async, work));
  for (std::future<void>& thread : threads) {
    while (thread.wait_for(kBetweenNews) != std::future_status::ready) tell();
    thread.get();
  }
  tell();
}

}  // namespace lorentz::flights
