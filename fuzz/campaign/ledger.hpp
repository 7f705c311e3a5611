// The ledger of a campaign. It hands out stints, and records their results in the order of the indices, so
// that it does not matter which thread did them, or when. It also hands out the recorded findings to be
// shrunk.
#pragma once

#include <condition_variable>
#include <mutex>
#include <utility>

#include "fuzz/campaign/work.hpp"

namespace lorentz::fuzz {

class Ledger final : public WorkSource {
 public:
  /// `threads`: of all processes together. `unshrunk`: findings from before that are not fully shrunk.
  Ledger(const Plan& plan, const Bounds& bounds, std::size_t threads, std::vector<TargetTally>& tallies,
         Journal& journal, const std::vector<Finding>& unshrunk = {});

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
  // A target in a running campaign.
  struct Track {
    TargetTally tally;                                             // of what is recorded
    std::uint64_t handed_out = 0;                                  // the first index that is not handed out
    std::size_t in_work = 0;                                       // stints handed out and not recorded
    double seconds = 0;                                            // of all threads, shrinking included
    std::optional<double> usual;                                   // recent seconds per case
    std::uint64_t pending = 0;                                     // indices handed out and not handed in
    std::map<std::uint64_t, std::pair<Stint, StintResult>> ready;  // by first index: done, not recorded

    std::multimap<int, Finding> due;  // to be shrunk, by rank_of()
    std::size_t in_shrinking = 0;     // handed out and not handed in
    double shrinking_seconds = 0;     // the part of `seconds` that went into shrinking
    std::uint64_t shrinkings = 0;     // number of findings shrunk in that time
    std::vector<Finding> shrunk;      // not recorded
  };

  Track* next_track();
  Assignment assign(Track& track, std::uint64_t batch_size, double seconds);
  Assignment assign_cases(Track& track, std::uint64_t batch_size, double seconds);
  Assignment assign_shrinking(Track& track);
  bool has_cases(const Track& track) const;
  bool shrinks_next(const Track& track) const;
  double usual_shrinking(const Track& track) const;
  double time_of(const Track& track) const;
  bool is_complete(const Track& track) const;
  bool record(std::size_t target);
  void record(Track& track, const Stint& stint, StintResult& result, std::vector<Finding>& kept);

  const Plan& plan_;
  const std::uint64_t count_;
  const bool first_;
  const std::size_t most_ahead_;
  const double most_shrinking_;  // seconds for one finding
  std::vector<TargetTally>& tallies_;
  Journal& journal_;
  std::vector<Track> tracks_;
  std::atomic<bool> stop_ = false, answerer_failed_ = false;
  bool is_closing_ = false;  // the first finding is recorded, and is the last: no more cases
  std::exception_ptr failure_;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace lorentz::fuzz
