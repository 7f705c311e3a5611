// Asks one engine questions from many sources, each for a while.
#pragma once

#include <atomic>
#include <chrono>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "judge/order.hpp"
#include "judge/results.hpp"

namespace lorentz::judge {

using question::Source;

/// A stretch of time.
class Countdown {
 public:
  using Clock = std::chrono::steady_clock;
  explicit Countdown(double seconds, Clock::time_point begun = Clock::now())
      : end_(begun + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}
  double left() const { return std::max(std::chrono::duration<double>(end_ - Clock::now()).count(), 0.0); }
  /// What the next of these parts gets; the others get the time that it leaves.
  double share(std::ptrdiff_t parts) const {
    return left() / static_cast<double>(std::max<std::ptrdiff_t>(parts, 1));
  }

 private:
  Clock::time_point end_;
};

inline constexpr double kEver = 1e7;  ///< seconds

class TimedExamination {
 public:
  /// Everything ends soon after another thread has set `stop`.
  TimedExamination(const JudgeOrder& order, question::AnswererOptions options, const std::atomic<bool>& stop);
  TimedExamination(const TimedExamination&) = delete;
  TimedExamination& operator=(const TimedExamination&) = delete;

  /// Sets a limit from now on: after `seconds` all is over, and no answer is waited for.
  void limit(double seconds) { end_ = Countdown(seconds); }
  bool is_over() const { return stop_ || end_.left() == 0; }

  /// Lets an external engine start: asks it a plain question, at most three times, until an answer comes
  /// fast. Returns the seconds of each answer. These answers are not counted unless one is missing.
  std::vector<double> warm_up();

  /// Asks up to `most` questions for at most `seconds` (later answers only to questions asked before), or
  /// until there are no more. A scene in which an external engine is given up is left. A row of the same name
  /// goes on. `look` sees each answer.
  void run(const ExaminedRow& row, const Source& source, double seconds, const question::Sink& look = {},
           std::size_t most = std::numeric_limits<std::size_t>::max());

  /// Asks questions while no row runs, without counting them. Returns for each that was answered what is wrong
  /// with the answer, if anything is.
  std::vector<std::optional<Example>> examples_of(std::span<const Question> questions);

  const JudgeOrder& order() const { return order_; }
  Results& results() { return results_; }
  /// True if an external engine failed or misbehaved at least once.
  bool failed() const { return results_.failed || examination_.failed(); }
  void finish();

 private:
  double ask(std::span<const Question> questions, const question::Sink& sink);
  void take(const Judged& judged, ExaminedRow& row);
  void leave(Place& place, ExaminedRow& row) const;
  std::optional<Example> example_in(const Judged& judged) const;

  const JudgeOrder order_;
  const std::atomic<bool>& stop_;
  Countdown end_{kEver};
  question::Examination examination_;
  bool has_answered_ = false;
  std::string last_fault_, last_words_;  // last_words_: written while the last questions were asked
  Results results_;
};

}  // namespace lorentz::judge
