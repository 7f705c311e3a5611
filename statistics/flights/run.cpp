#include "statistics/flights/run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <future>
#include <mutex>

#include <lorentz/errors.hpp>
#include "question/engines.hpp"

namespace lorentz::flights {
namespace {

using Clock = std::chrono::steady_clock;

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
      const std::uint64_t together = std::min(kTogether, count - done);
      starts_.draw(first + done, together, columns_);
      engine_.fly(columns_.view(), flights_);
      for (std::uint64_t i = 0; i < together; ++i)
        if (!this->count(flights_[i], first + done + i, tally)) inside_.push_back(first + done + i);
      draw_anew(tally);
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

  void draw_anew(FlightTally& tally) {
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

  const question::SceneEngine& engine_;
  const starts::Candidates starts_;
  starts::StartColumns columns_;
  QueryTable again_;
  FlightTable flights_;
  std::uint64_t inside_in_a_row_ = 0;  // consecutive candidates inside
  std::vector<std::uint64_t> inside_;  // starts whose last candidate lay in an obstacle
};

// Hands out the blocks in order and collects their tallies. The account belongs to the caller and is accessed
// only under the lock.
class BlockLedger {
 public:
  BlockLedger(const FlightsPlan& plan, const FlightBounds& bounds, Account& account)
      : plan_(plan), bounds_(bounds), account_(account), next_(bounds.shard) {
    if (bounds.seconds > 0)
      end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                std::chrono::duration<double>(std::min(bounds.seconds, 1e9)));
  }

  // Returns false if nothing is left to do.
  bool take(std::uint64_t& block) {
    const std::lock_guard lock(mutex_);
    if (has_failed_ || is_enough()) return false;
    while (next_ < plan_.blocks() && is_done(next_)) next_ += bounds_.shards;
    if (next_ >= plan_.blocks()) return false;
    block = next_;
    next_ += bounds_.shards;
    return true;
  }
  void hand_in(std::uint64_t block, const FlightTally& tally) {
    const std::lock_guard lock(mutex_);
    account_.tally.add(tally);
    account_.done += block;
  }
  // Nothing is left to do for any thread.
  void fail() {
    const std::lock_guard lock(mutex_);
    has_failed_ = true;
  }
  void tell(const OnProgress& on_progress) {
    const std::lock_guard lock(mutex_);
    if (on_progress) on_progress(account_);
  }

 private:
  bool is_done(std::uint64_t block) const {
    return contains(account_.done, block) || contains(bounds_.done, block);
  }
  bool is_enough() const {
    return (bounds_.stop && *bounds_.stop) || (bounds_.seconds > 0 && Clock::now() >= end_);
  }

  const FlightsPlan& plan_;
  const FlightBounds& bounds_;
  Account& account_;
  std::uint64_t next_;
  Clock::time_point end_;
  bool has_failed_ = false;
  std::mutex mutex_;
};

void work(const FlightsPlan& plan, const question::SceneEngine& engine, BlockLedger& ledger) {
  try {
    Flyer flyer(plan, engine);
    for (std::uint64_t block; ledger.take(block);) {
      FlightTally tally(unit_exponent(plan.scene));
      const std::uint64_t first = block * kBlock;
      flyer.fly(first, std::min(kBlock, plan.count - first), tally);
      ledger.hand_in(block, tally);
    }
  } catch (...) {
    ledger.fail();
    throw;
  }
}

}  // namespace

void run(const FlightsPlan& plan, const FlightBounds& bounds, Account& account,
         const OnProgress& on_progress) {
  const question::EngineInfo info = question::engine_named(plan.engine);
  if (const auto why = info.traits.is_exact ? std::nullopt : Reduction::beyond(plan.scene);
      why && info.traits.uses_reduction)
    throw InputError(fmt::format("the engine {} {}; certified does such scenes", info.name, *why));
  const question::SceneEngine engine = info.in(plan.scene);
  BlockLedger ledger(plan, bounds, account);
  std::vector<std::future<void>> threads;
  for (unsigned job = 0; job < bounds.jobs; ++job)
    threads.push_back(std::async(std::launch::async, [&] { work(plan, engine, ledger); }));
  for (std::future<void>& thread : threads) {
    while (thread.wait_for(kBetweenNews) != std::future_status::ready) ledger.tell(on_progress);
    thread.get();
  }
  ledger.tell(on_progress);
}

}  // namespace lorentz::flights
