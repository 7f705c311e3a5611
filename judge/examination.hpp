// Asks one engine questions from many sources, each for a while, and takes down what came of it.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "judge/findings.hpp"
#include "judge/measures.hpp"
#include "question/answerer.hpp"
#include "question/engines.hpp"
#include "question/examine.hpp"
#include "question/tally.hpp"

namespace lorentz::judge {

using question::Reply;
using question::Source;

/// Sees each answer of a row.
using Look = std::function<void(const Question&, const Answer& given)>;

/// Sees what was made of each answer of all rows.
using OnJudged = std::function<void(const std::string& row, const Question&, const oracle::Judgement&)>;

/// One kind of difficulty, and how the engine does there.
struct ExaminedRow {
  std::string name, explanation;
  bool is_hard = true;         ///< chosen to be difficult: no flights as they are drawn
  question::Tally tally = {};  ///< with ns_per_query, the mean, of another program by the wall
  /// Invalid questions that were answered as if they were valid; these are not in the tally.
  std::size_t nonsense = 0;
  std::optional<double> max_radii = {};       ///< the largest radii_off of a right obstacle
  std::optional<std::uint64_t> records = {};  ///< of a golden set: so many there are
  bool is_exhausted = false;                  ///< its source had no more questions that the engine does
  std::size_t scenes_given_up = 0;  ///< in which another program failed until it was asked no further
  std::string last_failure = {};    ///< of the last of these

  std::size_t asked() const { return tally.queries + nonsense; }
};

class Examination {
 public:
  /// If another thread sets `stop`, everything ends soon.
  Examination(const question::EngineInfo& engine, question::AnswererOptions options, double ulps,
              const std::atomic<bool>& stop, const Claim& claim = {});
  Examination(const Examination&) = delete;
  Examination& operator=(const Examination&) = delete;

  /// From now on for so many seconds: then all is over, and no answer is waited for.
  void limit(double seconds);

  /// From now on each row asks this number of questions, and slow scenes are asked, too.
  void ask_exactly(std::size_t questions) { most_ = questions; }

  /// Is called often while rows run, with the name of the row.
  void on_progress(std::function<void(const std::string&)> tell) { tell_ = std::move(tell); }

  /// Is called of each answer that a row's tally counts.
  void on_judged(OnJudged tell) { on_judged_ = std::move(tell); }

  /// Seconds that another program took to its first answer, and more than to the next; 0 of an engine here.
  struct Start {
    double first_answer = 0, start_up = 0;
  };
  /// Has another program start: asks it a plain question until the answer comes as fast as the one before,
  /// and counts that nowhere, but if there is none.
  Start warm_up();

  /// Asks for so many seconds at the most (beyond that only what was asked already), or until there is no
  /// more. A scene in which another program is given up is left.
  void run(ExaminedRow row, const Source& source, double seconds, const Look& look = {});

  /// Takes over what another examination of the same engine came to in its last row, and adds that to the
  /// last row here.
  void take_over(const Examination& other);

  /// Asks one question while no row runs, and counts it nowhere. Nothing if the answer is not wrong in any
  /// way.
  std::optional<Example> example_of(const Question& question);

  /// The same of so many copies of it, one after the other.
  struct Repeated {
    std::optional<std::size_t> failed;  ///< the number of the first whose answer goes wrong like this, from 1
    bool all_answered = false;          ///< there was time for all
  };
  Repeated repeat(const Question& question, std::size_t copies, Diagnosis like);

  /// What the engine is judged by, in all places.
  const Claim& claim() const { return claim_; }

  const std::vector<ExaminedRow>& rows() const { return rows_; }
  /// As Findings::all; what was unsupported was not asked.
  std::vector<Finding> findings() const;
  /// Of the first questions of each row, so many that rows weigh alike.
  const Curves& curves() const { return curves_; }

  /// Another program broke, or did what it should not, at least once.
  bool failed() const { return failed_ || answerer_->failed(); }
  bool is_over() const { return is_enough(); }
  void finish() { answerer_->finish(); }

 private:
  using Clock = std::chrono::steady_clock;

  bool is_enough() const { return stop_ || (end_ && Clock::now() >= *end_); }
  double ask(const std::vector<Question>& questions);
  void take(const Question& question, const Reply& reply, ExaminedRow& row);
  void leave(Place& place, ExaminedRow& row) const;
  static std::optional<Diagnosis> diagnosed(const Question& question, const Reply& reply,
                                            const oracle::Judgement& judgement);
  oracle::Judgement judgement_of(const Question& question, const Reply& reply) const;
  std::optional<Example> departing(const Question& question, const Reply& reply) const;

  const double ulps_;
  const Claim claim_;
  const std::atomic<bool>& stop_;
  std::optional<std::size_t> most_;  // questions of a row
  std::optional<Clock::time_point> end_;
  std::function<void(const std::string&)> tell_;
  OnJudged on_judged_;
  bool failed_ = false;  // of those that were taken over
  const bool runs_apart_;
  std::unique_ptr<question::Answerer> answerer_;
  std::vector<Reply> replies_;
  std::string last_fault_, last_words_;  // last_words_: while the last questions were asked
  std::vector<ExaminedRow> rows_;
  Findings findings_;
  Curves curves_;
};

}  // namespace lorentz::judge
