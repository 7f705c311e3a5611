// The work that the threads of a campaign take and give back, wherever the campaign's ledger is kept.
#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/campaign/stint.hpp"
#include "src/problem/threads.hpp"

namespace lorentz::fuzz {

/// A stint, and the number of findings of each sort that its target is certain to have from earlier indices.
/// Or, with an empty stint, a finding of its target to be shrunk.
struct Assignment {
  Stint stint;
  std::map<std::string, std::uint64_t> known = {};
  std::optional<Finding> due = {};
  double most_seconds = std::numeric_limits<double>::infinity();  ///< for shrinking it

  friend auto members_of(Assignment& self) {
    return std::tie(self.stint, self.known, self.due, self.most_seconds);
  }
};

/// The finished work; without a result or a finding if it was stopped.
struct Done {
  Stint stint;
  std::optional<StintResult> result = {};
  std::optional<Finding> shrunk = {};
  double seconds = 0;
  bool answerer_failed = false;  ///< the engine has broken at least once so far, and was started again

  friend auto members_of(Done& self) {
    return std::tie(self.stint, self.result, self.shrunk, self.seconds, self.answerer_failed);
  }
};

/// Called by any thread.
class WorkSource {
 public:
  virtual ~WorkSource() = default;

  /// The next work, for an answerer that prefers at least `batch_size` cases at a time; waits until there is
  /// some. Nothing if all is done, or the campaign is stopped.
  virtual std::optional<Assignment> take(std::uint64_t batch_size) = 0;
  virtual void hand_in(Done done) = 0;
  virtual void fail(std::exception_ptr failure) = 0;

  /// True once all work under way may be dropped.
  virtual const std::atomic<bool>& stop() const = 0;
};

/// Works with `jobs` threads, which end when there is no more work.
class Workers {
 public:
  Workers(const Plan& plan, const MakeAnswerer& make_answerer, WorkSource& source, unsigned jobs)
      : plan_(plan), make_answerer_(make_answerer), source_(source) {
    threads_ = threads_of(jobs, [this] { work(); });
    if (threads_.empty())
      throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again));
  }
  void join() { threads_.clear(); }

 private:
  void work() {
    using Clock = std::chrono::steady_clock;
    try {
      StintRunner runner(plan_, make_answerer_, source_.stop());
      while (const auto assignment = source_.take(runner.batch_size())) {
        const auto start = Clock::now();
        Done done{assignment->stint};
        if (assignment->due)
          done.shrunk = runner.shrink(*assignment->due, assignment->most_seconds);
        else
          done.result = runner.run(assignment->stint, assignment->known);
        done.seconds = std::chrono::duration<double>(Clock::now() - start).count();
        done.answerer_failed = runner.answerer_failed();
        source_.hand_in(std::move(done));
      }
    } catch (...) {
      source_.fail(std::current_exception());
    }
  }

  const Plan& plan_;
  const MakeAnswerer& make_answerer_;
  WorkSource& source_;
  std::vector<std::jthread> threads_;
};

}  // namespace lorentz::fuzz
