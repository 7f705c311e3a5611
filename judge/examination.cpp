#include "judge/examination.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "compare/registry.hpp"

namespace lorentz::judge {
namespace {

using Clock = std::chrono::steady_clock;
using oracle::Judgement;
using oracle::Verdict;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// What is asked together: so much that it takes this long, for a time limit is only looked at in between; and
// never much, for what is fast here can take a second a question in the next scene.
constexpr std::size_t kFewestAtOnce = 4, kMostAtOnce = 32;
constexpr double kSecondsAtOnce = 0.05;

std::size_t next_number(std::size_t asked, double took) {
  const double fitting = static_cast<double>(asked) * kSecondsAtOnce / std::max(took, 1e-9);
  const auto most = static_cast<double>(std::min(2 * asked, kMostAtOnce));
  return static_cast<std::size_t>(
      std::clamp(fitting, double{kFewestAtOnce}, std::max(most, double{kFewestAtOnce})));
}

// Right answers that are compared with the wrong ones, of each row.
constexpr std::size_t kCompared = 500;

// Answers that are the same need no judge, which most scenes therefore never get.
bool is_exact(const Answer& exact, const Answer& given) {
  if (given.outcome != exact.outcome) return false;
  if (exact.outcome == Outcome::never) return true;
  if (exact.outcome == Outcome::inside) return given.obstacle == exact.obstacle;
  return exact.outcome == Outcome::hit && given.obstacle == exact.obstacle && given.time == exact.time;
}

// The right answer to what is no question is `error`.
Judgement judgement_of_nonsense(const Answer& given) {
  if (given.outcome == Outcome::undecided) return {Verdict::undecided};
  if (given.outcome == Outcome::error) return {given.unsupported ? Verdict::unsupported : Verdict::agree};
  return {Verdict::wrong, {}, std::numeric_limits<double>::infinity()};
}

}  // namespace

Examination::Examination(const std::string& engine, const compare::AnswererOptions& options, double ulps,
                         const std::atomic<bool>& stop)
    : ulps_(ulps), stop_(stop), answerer_(compare::make_answerer(engine, options)) {
  answerer_->on_answer([this](Answer& answer) { answers_.push_back(std::move(answer)); });
}

// Returns how long it took.
double Examination::ask(const std::vector<Question>& questions) {
  answers_.clear();
  const auto start = Clock::now();
  for (const Question& question : questions) {
    if (question.setting != setting_) answerer_->set_scene((setting_ = question.setting)->scene());
    if (question.is_query())
      answerer_->ask("null", question.query);
    else
      answerer_->ask_text("null", question.text);
  }
  answerer_->drain();
  given_up_ |= answerer_->given_up();
  return seconds_since(start);
}

void Examination::run(Row row, const Source& source, double seconds) {
  const auto start = Clock::now();
  row.tally.name = row.name;
  double asking = 0;
  std::size_t compared = 0, at_once = kFewestAtOnce;
  std::vector<Question> questions;
  for (bool more = true; more && !is_over() && seconds_since(start) < seconds;) {
    questions.clear();
    while (questions.size() < at_once && !stop_ && seconds_since(start) < seconds) {
      std::optional<Question> next = source();
      if (!(more = next.has_value())) break;
      questions.push_back(std::move(*next));
    }
    if (tell_) tell_(row.name);
    const double took = ask(questions);
    asking += took;
    at_once = next_number(questions.size(), took);
    for (std::size_t i = 0; i < answers_.size(); ++i) {
      questions[i].setting->note_time(took / static_cast<double>(answers_.size()));
      take(questions[i], answers_[i], row, compared);
    }
  }
  if (row.tally.queries > 0) row.tally.ns_per_query = 1e9 * asking / static_cast<double>(row.tally.queries);
  rows_.push_back(std::move(row));
}

void Examination::take_over(const Examination& other) {
  compare::Tally& its = rows_.back().tally;
  const compare::Tally& more = other.rows_.back().tally;
  const auto time = [](const compare::Tally& t) { return t.ns_per_query * static_cast<double>(t.queries); };
  const double ns = time(its) + time(more);
  its.add(more);
  if (its.queries > 0) its.ns_per_query = ns / static_cast<double>(its.queries);
  findings_.add(other.findings_);
  failed_ |= other.failed();
}

Judgement Examination::judgement_of(const Question& question, const Answer& given) const {
  if (!question.is_query()) return judgement_of_nonsense(given);
  if (is_exact(question.exact, given)) {
    Judgement agrees{Verdict::agree};
    if (given.outcome == Outcome::hit) agrees.ulps = 0;
    return agrees;
  }
  return question.setting->judge().judge(question.query, question.exact, given, ulps_);
}

void Examination::take(const Question& question, const Answer& given, Row& row, std::size_t& compared) {
  const Judgement judgement = judgement_of(question, given);
  row.tally.count(judgement);
  question.setting->note(judgement.verdict == Verdict::unsupported);
  if (const auto diagnosis = diagnosis_of(question, given, judgement))
    findings_.add({question, given, judgement, *diagnosis});
  else if (judgement.verdict == Verdict::agree && question.is_query() && compared++ < kCompared)
    findings_.add_right(features_of(question));
}

std::optional<Example> Examination::example_of(const Question& question) {
  ask({question});
  if (answers_.size() != 1) return std::nullopt;
  const Judgement judgement = judgement_of(question, answers_[0]);
  const auto diagnosis = diagnosis_of(question, answers_[0], judgement);
  return diagnosis ? std::optional(Example{question, answers_[0], judgement, *diagnosis}) : std::nullopt;
}

}  // namespace lorentz::judge
