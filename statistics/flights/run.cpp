#include "statistics/flights/run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include <lorentz/errors.hpp>
#include "statistics/flights/flyer.hpp"

namespace lorentz::flights {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenNews{200};

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
    if (failure_ || is_enough()) return false;
    while (next_ < plan_.blocks() && is_done(next_)) next_ += bounds_.shards;
    if (next_ >= plan_.blocks()) return false;
    block = next_;
    next_ += bounds_.shards;
    return true;
  }
  void hand_in(std::uint64_t block, const FlightTally& tally) {
    const std::lock_guard lock(mutex_);
    account_.tally.add(tally);
    account_.done.insert(block);
  }
  void fail(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::move(failure);
  }
  void leave() {
    const std::lock_guard lock(mutex_);
    --at_work_;
    left_.notify_all();
  }

  // Waits until all threads have left, and reports progress at intervals. Rethrows an exception of a thread.
  void watch(unsigned jobs, const OnProgress& on_progress) {
    std::unique_lock lock(mutex_);
    at_work_ += static_cast<int>(jobs);
    while (!left_.wait_for(lock, kBetweenNews, [&] { return at_work_ == 0; }))
      if (on_progress) on_progress(account_);
    if (failure_) std::rethrow_exception(failure_);
    if (on_progress) on_progress(account_);
  }

 private:
  bool is_done(std::uint64_t block) const {
    return account_.done.contains(block) || bounds_.done.contains(block);
  }
  bool is_enough() const {
    return (bounds_.stop && *bounds_.stop) || (bounds_.seconds > 0 && Clock::now() >= end_);
  }

  const FlightsPlan& plan_;
  const FlightBounds& bounds_;
  Account& account_;
  std::uint64_t next_;
  Clock::time_point end_;
  int at_work_ = 0;
  std::exception_ptr failure_;
  std::mutex mutex_;
  std::condition_variable left_;
};

void work(const FlightsPlan& plan, const question::ColumnFlyer& engine, BlockLedger& ledger) {
  try {
    Flyer flyer(plan, engine);
    for (std::uint64_t block; ledger.take(block);) {
      FlightTally tally(unit_exponent(plan.scene));
      const std::uint64_t first = block * kBlock;
      flyer.fly(first, std::min(kBlock, plan.count - first), tally);
      ledger.hand_in(block, tally);
    }
  } catch (...) {
    ledger.fail(std::current_exception());
  }
  ledger.leave();
}

}  // namespace

void run(const FlightsPlan& plan, const FlightBounds& bounds, Account& account,
         const OnProgress& on_progress) {
  const question::EngineInfo info = question::engine_named(plan.engine);
  if (const auto why = info.traits.is_exact ? std::nullopt : Reduction::beyond(plan.scene);
      why && info.traits.uses_reduction)
    throw InputError(fmt::format("the engine {} {}; certified does such scenes", info.name, *why));
  const question::ColumnFlyer engine(info, plan.scene);
  BlockLedger ledger(plan, bounds, account);
  std::vector<std::jthread> threads;
  for (unsigned job = 0; job < bounds.jobs; ++job) threads.emplace_back([&] { work(plan, engine, ledger); });
  ledger.watch(bounds.jobs, on_progress);
}

}  // namespace lorentz::flights
