#include "judge/examination.hpp"

#include <algorithm>

#include "judge/plan.hpp"

namespace lorentz::judge {
namespace {

using question::Origin;
using question::Reply;

// The number of questions that are asked together: always the same if they are counted, because scenes are
// left in between. Else they should take kSecondsAtOnce, because time limits are only checked in between. The
// number stays small, because an engine that is fast here can take a second per question in the next scene.
constexpr std::size_t kFewestAtOnce = 4, kMostAtOnce = 32, kCountedAtOnce = 16;
constexpr double kSecondsAtOnce = 0.05;

std::size_t next_number(std::size_t asked, double took) {
  const double fitting = static_cast<double>(asked) * kSecondsAtOnce / std::max(took, 1e-9);
  const auto most = static_cast<double>(std::min(2 * asked, kMostAtOnce));
  return static_cast<std::size_t>(
      std::clamp(fitting, double{kFewestAtOnce}, std::max(most, double{kFewestAtOnce})));
}

question::AnswererOptions ended_by(question::AnswererOptions options, std::function<bool()> enough) {
  options.enough = std::move(enough);
  return options;
}

}  // namespace

TimedExamination::TimedExamination(const JudgeOrder& order, question::AnswererOptions options,
                                   const std::atomic<bool>& stop)
    : order_(order),
      stop_(stop),
      examination_(order.engine, ended_by(std::move(options), [this] { return is_over(); }), order.ulps) {}

std::vector<double> TimedExamination::warm_up() {
  constexpr std::size_t kTries = 3;
  constexpr double kFast = 0.05;
  std::vector<double> seconds;
  if (!order_.engine.runs_apart()) return seconds;
  std::optional<Question> question;
  JudgePlan plan(order_);
  for (PlannedRow& row : plan.rows())
    if (!question && !is_over()) question = row.source();
  if (!question) return seconds;
  while (seconds.size() < kTries && !is_over() && (seconds.empty() || seconds.back() > kFast)) {
    std::optional<Reply> reply;
    seconds.push_back(ask({&*question, 1}, [&](const Judged& judged) { reply = judged.reply; }));
    if (!examination_.failed()) continue;
    if (!reply || !reply->was_asked())
      reply = {Answer::error("the engine gave no answer while there was time"), Origin::fault};
    ExaminedRow& row =
        results_.row({.name = "first question", .explanation = "one question, before anything else"});
    take({*question, *reply, {oracle::Verdict::missing}}, row);
    break;
  }
  return seconds;
}

double TimedExamination::ask(std::span<const Question> questions, const question::Sink& sink) {
  examination_.answerer().take_last_words();  // what it wrote about earlier questions is dropped
  bool is_first = true;
  return examination_.ask(questions, [&](const Judged& judged) {
    if (std::exchange(is_first, false)) last_words_ = examination_.answerer().take_last_words();
    has_answered_ |= judged.reply.was_asked() && !judged.reply.is_fault();
    sink(judged);
  });
}

void TimedExamination::run(const ExaminedRow& of, const Source& source, double seconds,
                           const question::Sink& look, std::size_t most) {
  const Countdown time(seconds);
  ExaminedRow& row = results_.row(of);
  row.is_exhausted = false;
  examination_.try_again();
  const bool counted = order_.questions.has_value();
  std::size_t at_once = counted ? kCountedAtOnce : kFewestAtOnce,
              left = std::min(most, order_.questions.value_or(most));
  std::vector<Question> questions;
  while (!row.is_exhausted && left > 0 && !is_over() && time.left() > 0) {
    questions.clear();
    while (questions.size() < std::min(at_once, left) && !stop_ && time.left() > 0) {
      std::optional<Question> next = source();
      if ((row.is_exhausted = !next)) break;
      questions.push_back(std::move(*next));
    }
    left -= questions.size();
    if (order_.on_progress) order_.on_progress(row.name);
    const double took = ask(questions, [&](const Judged& judged) {
      take(judged, row);
      if (look && judged.reply.was_asked()) look(judged);
    });
    row.seconds += took;
    if (!counted) {
      at_once = row.tally[Count::too_slow] > 0 ? 1 : next_number(questions.size(), took);
      for (const Question& question : questions)
        question.place->note_time(took / static_cast<double>(questions.size()));
    }
    if (examination_.answerer().given_up() && !questions.empty()) leave(*questions.back().place, row);
    if (examination_.answerer().is_hopeless()) break;
  }
  set_speed(row);
}

void TimedExamination::leave(Place& place, ExaminedRow& row) const {
  if (place.is_given_up()) return;
  place.give_up();
  ++row.scenes_given_up;
  row.last_failure = last_fault_;
}

std::optional<Example> TimedExamination::example_in(const Judged& judged) const {
  const auto& [question, reply, judgement] = judged;
  auto diagnosis = reply.was_asked() ? diagnosis_of(question, reply.answer, judgement) : std::nullopt;
  if (!diagnosis) return std::nullopt;
  if (reply.origin == Origin::bad_line) diagnosis->cause = Cause::bad_line;
  return Example{question, reply.answer, judgement, *diagnosis, last_words_};
}

void TimedExamination::take(const Judged& judged, ExaminedRow& row) {
  const auto& [question, reply, judgement] = judged;
  if (!reply.was_asked()) {
    if (!is_over()) leave(*question.place, row);
    return;
  }
  if (reply.is_fault()) last_fault_ = reply.answer.message;
  const bool is_slowness =
      order_.takes_silence_for_slowness() && has_answered_ && reply.origin == Origin::silent;
  if (is_slowness) question.place->note_silence();
  results_.take(judged, example_in(judged), is_slowness, row);
  if (order_.questions && order_.on_judged) order_.on_judged(row.name, judged);
  question.place->note(judgement.verdict == oracle::Verdict::unsupported);
}

std::vector<std::optional<Example>> TimedExamination::examples_of(std::span<const Question> questions) {
  std::vector<std::optional<Example>> examples;
  examination_.try_again();
  ask(questions, [&](const Judged& judged) {
    if (judged.reply.was_asked()) examples.push_back(example_in(judged));
  });
  return examples;
}

void TimedExamination::finish() {
  examination_.finish();
  results_.failed |= examination_.failed();
}

}  // namespace lorentz::judge
