// What `lorentz judge` is to do: the engine, what it is asked, and by what it is judged. Asks one engine questions
// from many sources, each for a while.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lorentz/claim.hpp>
#include <lorentz/verdict.hpp>
#include "judge/results.hpp"
#include "question/engines.hpp"
#include "question/examine.hpp"
#include "question/starts/free_starts.hpp"

namespace lorentz::judge {

using question::Source;

/// Sees each judged answer of all rows.
using OnJudged = std::function<void(const std::string& row, const question::Judged&)>;

struct JudgeOrder {
  question::EngineInfo engine = {};
  /// What the engine reports about itself, if it was asked.
  std::optional<question::Introduction> introduction = {};
  std::string command = {};  ///< the shell line as typed
  std::uint64_t seed = starts::kDefaultSeed;
  double ulps = oracle::kDefaultUlps;  ///< the tolerance k
  Claim claim = {};
  bool times = false;   ///< wrong times count
  bool strict = false;  ///< answers to invalid questions count

  bool quick = false;               ///< fewer flights in less time
  std::optional<double> time = {};  ///< seconds in all; nothing: the usual time
  /// The number of questions of each row, instead of a time: every machine asks the same.
  std::optional<std::size_t> questions = {};
  unsigned jobs = 1;                   ///< threads of the campaign; one if questions are counted
  std::optional<double> timeout = {};  ///< for an external engine; nothing: a tenth of the time
  question::Listener listener = {};
  std::function<void(const std::string& row)> on_progress = {};  ///< called often, with the name of the row
  OnJudged on_judged = {};  ///< called for each answer, if questions are counted
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();  ///< of the time

  /// Duration from `begun` on; meaningless if questions are counted. Only an engine of this program or of the
  /// caller, which cannot be interrupted, makes the run longer.
  double seconds() const;
  /// Whether an external engine that has answered before and is silent for too long is too slow for the time of
  /// this run, which is not a fault.
  bool takes_silence_for_slowness() const { return !questions && !timeout; }
};

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
