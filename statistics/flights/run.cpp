#include "statistics/flights/run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <mutex>
#include <numeric>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include "question/engines.hpp"
#include "src/engines/gpu/gpu_batch.hpp"
#include "src/problem/scene_geometry.hpp"
#include "src/problem/threads.hpp"
#include "statistics/flights/card_flights.hpp"

namespace lorentz::flights {
namespace {

constexpr std::chrono::milliseconds kBetweenNews{200};
constexpr int kMostExponent = 250;  // squares of paths, which may be 2^60 times as long, are numbers then

// Draws the starts of flights, flies them and counts the results, block by block. Each thread has its own.
class Flyer {
 public:
  Flyer(const FlightsPlan& plan, const question::SceneEngine& engine, bool hard = false)
      : engine_(engine), starts_(plan.scene, plan.from, plan.seed, plan.cells), hard_(hard) {}

  // Flies the starts [first, first + count) and adds the results to the tally. Throws InputError if a start
  // cannot be found, or the engine cannot answer.
  void fly(std::uint64_t first, std::uint64_t count, FlightTally& tally) {
    // Few enough that their columns stay in the cache, or enough for a card.
    const std::uint64_t together = std::max<std::uint64_t>(4096, engine_.traits().together);
    for (std::uint64_t done = 0; done < count; done += together) {
      missing_.resize(std::min(together, count - done));
      std::iota(missing_.begin(), missing_.end(), first + done);
      fly_from(0, tally);
    }
  }

  // Flies one start from this attempt on.
  void fly(const gpu::LeftStart& left, FlightTally& tally) {
    missing_ = {left.index};
    fly_from(left.attempt, tally);
  }

 private:
  void fly_from(std::uint64_t attempt, FlightTally& tally) {
    for (; !missing_.empty(); ++attempt) fly_missing(attempt, tally);
  }

  // Counts a flight. Returns false if the start lies in an obstacle.
  bool count(const Flight& flight, std::uint64_t index, FlightTally& tally) {
    if (flight.outcome != Outcome::inside) inside_in_a_row_ = 0;
    switch (flight.outcome) {
      case Outcome::hit:
        tally.count_hit(flight.time);
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
    if (hard_) make_hard();
    engine_.fly(question::view_of(rows_), flights_);
    std::size_t still = 0;
    for (std::size_t i = 0; i < missing_.size(); ++i)
      if (!count(flights_[i], missing_[i], tally)) missing_[still++] = missing_[i];
    missing_.resize(still);
  }

  void make_hard() {
    const int dimension = rows_.x[2].empty() ? 2 : 3;
    for (std::size_t i = 0; i < missing_.size(); ++i) {
      double x[3] = {}, v[3] = {};
      for (int k = 0; k < dimension; ++k) x[k] = rows_.x[k][i], v[k] = rows_.v[k][i];
      gpu::make_hard(x, v, dimension);
      for (int k = 0; k < dimension; ++k) rows_.v[k][i] = v[k];
    }
  }

  const question::SceneEngine& engine_;
  const starts::Candidates starts_;
  const bool hard_;  // as gpu::make_hard has directions
  QueryRows rows_;
  FlightTable flights_;
  std::uint64_t inside_in_a_row_ = 0;   // consecutive candidates inside
  std::vector<std::uint64_t> missing_;  // starts whose last candidate, if any, lay in an obstacle
};

bool has_moderate_lengths(const Scene& scene) {
  bool good = true;
  const double most = std::ldexp(1.0, kMostExponent);
  const auto see = [&](double length) { good &= length > 1 / most && length < most; };
  for (const Lattice& lattice : scene.lattices) {
    for (int i = 0; i < lattice.rank_in(scene.dimension); ++i) see(length(lattice.vectors[i]));
    for (const Atom& atom : lattice.atoms)
      for (int i = 0; i < scene.dimension; ++i) see(principal_semiaxes(atom, scene.dimension)[i]);
  }
  return good;
}

// Who flies starts that are drawn here. Those of a card's plan, which are its own, are left to the processor.
question::SceneEngine engine_of(const FlightsPlan& plan, bool on_card) {
  if (!has_moderate_lengths(plan.scene))
    throw InputError(fmt::format(
        "free paths are measured in scenes whose lengths lie between 2^-{0} and 2^{0}; choose another unit",
        kMostExponent));
  if (on_card) gpu::prepared(plan.scene);  // throws with the reason
  const question::EngineInfo info = question::engine_named(on_card ? "gpu" : plan.engine);
  if (const auto why = info.traits.is_exact ? std::nullopt : Reduction::beyond(plan.scene);
      why && info.traits.uses_reduction)
    throw InputError(fmt::format("the engine {} {}; certified does such scenes", info.name, *why));
  return info.in(plan.scene);
}

// The blocks that are to be flown, and the account of those that are.
class BlocksToFly {
 public:
  BlocksToFly(const FlightsPlan& plan, const FlightBounds& bounds, Account& account)
      : plan_(plan), bounds_(bounds), account_(account), next_(bounds.shard) {}

  // Takes the next blocks, at most `most`. False: all are taken, or it is time to stop.
  bool take(std::uint64_t most, BlockRange& blocks) {
    const std::lock_guard lock(mutex_);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin_;
    if (has_failed_ || (bounds_.stop && *bounds_.stop) ||
        (bounds_.seconds > 0 && taken.count() >= bounds_.seconds))
      return false;
    while (next_ < plan_.blocks() && is_done(next_)) next_ += bounds_.shards;
    blocks = {next_, 0, bounds_.shards};
    for (; blocks.count < most && next_ < plan_.blocks() && !is_done(next_); next_ += bounds_.shards)
      ++blocks.count;
    return blocks.count > 0;
  }

  void finished(const BlockRange& blocks, const FlightTally& tally) {
    const std::lock_guard lock(mutex_);
    account_.tally.add(tally);
    for (std::uint64_t i = 0; i < blocks.count; ++i) account_.done += blocks.first + i * blocks.every;
  }

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

  const FlightsPlan& plan_;
  const FlightBounds& bounds_;
  Account& account_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::mutex mutex_;  // of the account and of the next two
  std::uint64_t next_;
  bool has_failed_ = false;
};

void fly_blocks(const FlightsPlan& plan, const question::SceneEngine& engine, BlocksToFly& work) {
  Flyer flyer(plan, engine);
  for (BlockRange block; work.take(1, block);) {
    FlightTally tally(unit_exponent(plan.scene));
    flyer.fly(block.first * kBlock, std::min(kBlock, plan.count - block.first * kBlock), tally);
    work.finished(block, tally);
  }
}

// Starts that a card leaves, on all threads.
void fly_left(const FlightsPlan& plan, const question::SceneEngine& engine, unsigned jobs,
              const std::vector<gpu::LeftStart>& left, FlightTally& tally, bool hard = false) {
  const auto share = [&](unsigned job) {
    FlightTally own(unit_exponent(plan.scene));
    Flyer flyer(plan, engine, hard);
    for (std::size_t i = job; i < left.size(); i += jobs) flyer.fly(left[i], own);
    return own;
  };
  std::vector<std::future<FlightTally>> others;
  for (unsigned job = 1; job < jobs && job < left.size(); ++job)
    others.push_back(std::async(kInThreadIfPossible, share, job));
  tally.add(share(0));
  for (std::future<FlightTally>& other : others) tally.add(other.get());
}

// Flies drawn and hard flights on the card and on the processor: what the driver makes of a kernel was in no
// test. Throws std::runtime_error if a bit of what is counted differs.
void compare_with_processor(const FlightsPlan& plan, const question::SceneEngine& engine, unsigned number) {
  for (const bool hard : {false, true}) {
    FlightsPlan some = plan;
    some.count = hard ? 10'000 : 100'000;
    FlightTally here(unit_exponent(plan.scene)), there = here;
    Flyer(some, engine, hard).fly(0, some.count, here);
    CardFlights card(some, number, hard);
    std::vector<gpu::LeftStart> left;
    card.start({0, some.blocks(), 1});
    card.finish(there, left);
    fly_left(some, engine, 1, left, there, hard);
    if (!(here == there))
      throw std::runtime_error(fmt::format(
          "of {} flights the graphics card ({}) does not give the bits of the processor; it is not used: "
          "certified-batch flies them here",
          some.count, card.card_name()));
  }
}

// While the card flies, the threads here fly what it left before.
void fly_on_card(const FlightsPlan& plan, const question::SceneEngine& engine, const FlightBounds& bounds,
                 BlocksToFly& work) {
  compare_with_processor(plan, engine, *bounds.card);
  CardFlights card(plan, *bounds.card);
  BlockRange now, before{};
  FlightTally tally(unit_exponent(plan.scene));
  std::vector<gpu::LeftStart> left;
  for (bool goes_on = true; goes_on;) {
    goes_on = work.take(card.most_blocks(), now);
    if (goes_on) card.start(now);
    if (before.count > 0) {
      fly_left(plan, engine, bounds.jobs, left, tally);
      work.finished(before, tally);
    }
    if (!goes_on) return;
    tally = FlightTally(unit_exponent(plan.scene));
    card.finish(tally, left);
    before = now;
  }
}

}  // namespace

void run(const FlightsPlan& plan, const FlightBounds& bounds, Account& account,
         const OnProgress& on_progress) {
  const bool draws_there = bounds.card && plan.from == Ensemble::uniform;
  const question::SceneEngine engine = engine_of(plan, bounds.card && !draws_there);
  BlocksToFly work(plan, bounds, account);
  const auto fly = [&] {
    try {
      if (draws_there)
        fly_on_card(plan, engine, bounds, work);
      else
        fly_blocks(plan, engine, work);
    } catch (...) {
      work.fail();
      throw;
    }
  };
  std::vector<std::future<void>> threads;
  try {
    for (unsigned job = 0; job < (draws_there ? 1 : bounds.jobs); ++job)
      threads.push_back(std::async(std::launch::async, fly));
  } catch (const std::system_error&) {  // those that were started do it all
    if (threads.empty()) throw;
  }
  for (std::future<void>& thread : threads) {
    while (thread.wait_for(kBetweenNews) != std::future_status::ready) work.tell(on_progress);
    thread.get();
  }
  work.tell(on_progress);
}

}  // namespace lorentz::flights
