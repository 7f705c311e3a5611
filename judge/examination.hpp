// Asks one engine questions from many sources, each for a while, and records the results.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "judge/findings.hpp"
#include "question/answerer.hpp"
#include "question/engines.hpp"
#include "question/examine.hpp"
#include "question/tally.hpp"
#include "report/calls.hpp"

namespace lorentz::judge {

using question::Count;
using question::Counted;
using question::Reply;
using question::Source;

/// Sees each answer of a row.
using Look = std::function<void(const Question&, const Answer& given)>;

/// Sees the judgement on each answer of all rows.
using OnJudged = std::function<void(const std::string& row, const Question&, const oracle::Judgement&)>;

/// What makes a question hard: the measures by which an engine's answers are counted, in the order of `sizes`
/// in Examination::take. The first is that of the page's `calls`.
inline constexpr std::array kMeasures{
    "radii by which the line enters or misses the obstacle in question",
    "radii from the start to the obstacle in question", "length of the flight, in lattice vectors",
    "distance of the start from the origin, in lattice vectors", "smallest radius, in lattice vectors"};

/// One curve for each measure.
using Curves = std::array<report::Calls, kMeasures.size()>;

/// One kind of difficulty, and the engine's results there.
struct ExaminedRow {
  std::string name, explanation;
  bool is_hard = true;         ///< chosen to be difficult, in contrast to drawn flights
  question::Tally tally = {};  ///< with the mean ns_per_query; wall-clock time for an external program
  std::optional<double> max_radii = {};       ///< the largest radii_off of a right obstacle
  std::optional<std::uint64_t> records = {};  ///< the size of a golden set
  bool is_exhausted = false;                  ///< its source had no more questions that the engine supports
  std::size_t scenes_given_up = 0;  ///< scenes in which an external engine failed until it was given up
  std::string last_failure = {};    ///< in the last of these
  double seconds = 0;               ///< that the answers took

  std::size_t asked() const { return tally.queries + tally.counts.sum({Count::nonsense, Count::too_slow}); }
};

class Examination {
 public:
  /// Everything ends soon after another thread has set `stop`.
  Examination(const question::EngineInfo& engine, question::AnswererOptions options, double ulps,
              const std::atomic<bool>& stop, const Claim& claim = {});
  Examination(const Examination&) = delete;
  Examination& operator=(const Examination&) = delete;

  /// Sets a limit from now on: after `seconds` all is over, and no answer is waited for.
  void limit(double seconds);

  /// From now on each row asks this number of questions, the same ones however long each takes: slow scenes
  /// are asked, too.
  void ask_exactly(std::size_t questions) { most_ = questions; }

  /// From now on an external engine that has answered before and is silent for too long is too slow for the
  /// time of this run, which is not a fault: the scene is left.
  void take_silence_for_slowness() { silence_is_slowness_ = true; }

  /// `tell` is called often while rows run, with the name of the row.
  void on_progress(std::function<void(const std::string&)> tell) { tell_ = std::move(tell); }

  /// `tell` is called for each answer that a row's tally counts.
  void on_judged(OnJudged tell) { on_judged_ = std::move(tell); }

  /// Seconds that an external engine took until its first answer, and how much longer that was than for the
  /// next answer; 0 for an engine of this program.
  struct Start {
    double first_answer = 0, start_up = 0;
  };
  /// Lets an external engine start: asks it a plain question, at most three times, until an answer comes
  /// fast. These answers are not counted unless one is missing.
  Start warm_up();

  /// Adds a row without results, unless there is one of this name.
  ExaminedRow& add(ExaminedRow row);

  /// Asks up to `most` questions for at most `seconds` (later answers only to questions asked before), or
  /// until there are no more. A scene in which an external engine is given up is left. A row of the same name
  /// goes on.
  void run(ExaminedRow row, const Source& source, double seconds, const Look& look = {},
           std::size_t most = std::numeric_limits<std::size_t>::max());

  /// Adds the results of another examination of the same engine, row by row.
  void take_over(const Examination& other);

  /// Asks one question while no row runs, without counting it. Nothing if the answer is not wrong in any way.
  std::optional<Example> example_of(const Question& question);

  /// The result of asking a number of copies of a question, one after the other.
  struct Repeated {
    std::optional<std::size_t> failed;  ///< number, from 1, of the first copy that fails like this
    bool all_answered = false;          ///< there was time for all
  };
  Repeated repeat(const Question& question, std::size_t copies, Diagnosis like);

  /// The claim by which the engine is judged, in all places.
  const Claim& claim() const { return claim_; }

  const std::vector<ExaminedRow>& rows() const { return rows_; }
  /// As Findings::all; unsupported questions do not count as asked.
  std::vector<Finding> findings() const;
  /// The curves of the first questions of each row, limited in number so that rows weigh alike.
  const Curves& curves() const { return curves_; }

  /// True if an external engine failed or misbehaved at least once.
  bool failed() const { return failed_ || answerer_->failed(); }
  bool is_over() const { return is_enough(); }
  void finish() { answerer_->finish(); }

 private:
  using Clock = std::chrono::steady_clock;

  bool is_enough() const { return stop_ || (end_ && Clock::now() >= *end_); }
  double ask(const std::vector<Question>& questions);
  void take(const Question& question, const Reply& reply, ExaminedRow& row);
  void leave(Place& place, ExaminedRow& row) const;
  oracle::Judgement judgement_of(const Question& question, const Reply& reply) const;
  std::optional<Example> departing(const Question& question, const Reply& reply,
                                   const oracle::Judgement& judgement) const;
  std::optional<Example> departing(const Question& question, const Reply& reply) const;

  const double ulps_;
  const Claim claim_;
  const std::atomic<bool>& stop_;
  std::optional<std::size_t> most_;  // questions of a row
  bool silence_is_slowness_ = false, has_answered_ = false;
  std::optional<Clock::time_point> end_;
  std::function<void(const std::string&)> tell_;
  OnJudged on_judged_;
  bool failed_ = false;  // true if one that was taken over failed
  const bool runs_apart_;
  std::unique_ptr<question::Answerer> answerer_;
  std::vector<Reply> replies_;
  std::string last_fault_, last_words_;  // last_words_: written while the last questions were asked
  std::vector<ExaminedRow> rows_;
  Findings findings_;
  Curves curves_;
};

}  // namespace lorentz::judge
