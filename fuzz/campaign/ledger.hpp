// The ledger of a campaign. Each target has a queue of the stints that are handed out. Their results are
// recorded in the order of the indices, so that it does not matter which thread did them, or when. The ledger
// also hands out the recorded findings to be shrunk.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>

#include "fuzz/campaign/work.hpp"

namespace lorentz::fuzz {

class Ledger final : public WorkSource {
 public:
  /// `threads`: of all processes together. `known`: findings from before; those that are not fully shrunk are due.
  Ledger(const Plan& plan, const Bounds& bounds, std::size_t threads, std::vector<TargetTally>& tallies,
         Journal& journal, const std::vector<Finding>& known = {});

  std::optional<Assignment> take(std::uint64_t batch_size) override;
  void hand_in(Done done) override;
  void fail(std::exception_ptr failure) override;
  const std::atomic<bool>& stop() const override { return stop_; }

  /// Up to `most` assignments that are ready without waiting, for another process.
  std::vector<Assignment> take_some(std::size_t most, std::uint64_t batch_size);

  /// Records what is ready. Returns whether there may be more. Rethrows the failure of a thread.
  bool record();
  void stop_all();
  bool had_failing_answerer() const { return answerer_failed_; }

 private:
  // A stint that is handed out and not recorded, with its result once it is done.
  struct Place {
    Stint stint;
    std::optional<StintResult> result = {};
  };

  // A target in a running campaign. Times are of all threads, as measured.
  struct Queue {
    std::deque<Place> places;         // consecutive, from the tally's `next` on
    std::multimap<int, Finding> due;  // to be shrunk, by rank_of()
    std::vector<Finding> shrunk;      // not recorded
    std::size_t under_way = 0;        // handed out and not handed in: stints and findings,
    std::size_t in_shrinking = 0;     // and the findings alone
    double seconds = 0;               // shrinking included,
    double shrinking_seconds = 0;     // and shrinking alone
    double pace = 0;                  // recent seconds for a case, for the length of stints; 0: none is known
  };

  Queue* next_queue();
  Assignment assign(Queue& queue, std::uint64_t batch_size);
  Assignment assign_cases(Queue& queue, std::uint64_t batch_size);
  Assignment assign_shrinking(Queue& queue);
  std::size_t target_of(const Queue& queue) const {
    return static_cast<std::size_t>(&queue - queues_.data());
  }
  std::uint64_t next_index(const Queue& queue) const;
  bool has_cases(const Queue& queue) const;
  bool shrinks_next(const Queue& queue) const;
  bool is_complete(const Queue& queue) const;
  bool record(Queue& queue);
  void record(Queue& queue, Place& first, std::vector<Finding>& kept);

  const Plan& plan_;
  const std::uint64_t count_;
  const bool first_;
  const std::size_t threads_;
  const double most_shrinking_;        // seconds for one finding
  std::vector<TargetTally>& tallies_;  // of what is recorded
  Journal& journal_;
  std::vector<Queue> queues_;
  std::atomic<bool> stop_ = false, answerer_failed_ = false;
  bool is_closing_ = false;  // the first finding is recorded, and is the last: no more cases
  std::exception_ptr failure_;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace lorentz::fuzz
