#include "judge/examination.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "question/engines.hpp"
#include "question/radii.hpp"

namespace lorentz::judge {
namespace {

using oracle::Judgement;
using oracle::Verdict;
using question::Origin;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

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

void set_speed(ExaminedRow& row) {
  if (row.tally.queries > 0)
    row.tally.speed.ns_per_query = 1e9 * row.seconds / static_cast<double>(row.tally.queries);
}

// Number of questions of each row that are examined closely: the features of right answers, and how close the
// calls were.
constexpr std::size_t kCompared = 500;

}  // namespace

Examination::Examination(const question::EngineInfo& engine, question::AnswererOptions options, double ulps,
                         const std::atomic<bool>& stop, const Claim& claim)
    : ulps_(ulps), claim_(claim), stop_(stop), runs_apart_(engine.runs_apart()) {
  options.enough = [this] { return is_enough(); };
  answerer_ = engine.answerer(options);
}

void Examination::limit(double seconds) {
  end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

Examination::Start Examination::warm_up() {
  constexpr int kTries = 3;
  constexpr double kFast = 0.05;  // seconds
  if (!runs_apart_) return {};
  const auto place = std::make_shared<Place>(unit_scene(2, 0.25), question::Truth::oracle, claim_);
  const Query along{{0.5, 0, 0}, {1, 0, 0}, {}};
  const Question question{
      .place = place, .query = along, .exact = place->exact(along), .where = "the first question"};
  double longest = 0, last = 0;
  for (int i = 0; i < kTries && !is_over() && (i == 0 || last > kFast); ++i) {
    longest = std::max(longest, last = ask({question}));
    if (!answerer_->failed()) continue;
    ExaminedRow row{"first question", "an empty place in the square lattice, before anything else"};
    if (replies_.empty() || !replies_[0].was_asked())
      replies_ = {{Answer::error("the engine gave no answer while there was time"), Origin::fault}};
    take(question, replies_[0], row);
    rows_.push_back(std::move(row));
    break;
  }
  return {longest, longest - last};
}

// Returns how long the answers took.
double Examination::ask(const std::vector<Question>& questions) {
  replies_.clear();
  answerer_->take_last_words();  // what it wrote about earlier questions is dropped
  const auto start = Clock::now();
  question::ask_all(question::all_of(questions), *answerer_, [this](const Question&, Reply& reply) {
    has_answered_ |= reply.was_asked() && !reply.is_fault();
    replies_.push_back(std::move(reply));
  });
  const double took = seconds_since(start);
  last_words_ = answerer_->take_last_words();
  return took;
}

ExaminedRow& Examination::add(ExaminedRow row) {
  const auto place = std::ranges::find(rows_, row.name, &ExaminedRow::name);
  if (place != rows_.end()) return *place;
  row.tally.name = row.name;
  rows_.push_back(std::move(row));
  return rows_.back();
}

void Examination::run(ExaminedRow of, const Source& source, double seconds, const Look& look,
                      std::size_t most) {
  const auto start = Clock::now();
  ExaminedRow& row = add(std::move(of));
  row.is_exhausted = false;
  answerer_->try_again();
  std::size_t at_once = most_ ? kCountedAtOnce : kFewestAtOnce, left = std::min(most, most_.value_or(most));
  std::vector<Question> questions;
  while (!row.is_exhausted && left > 0 && !is_over() && seconds_since(start) < seconds) {
    questions.clear();
    while (questions.size() < std::min(at_once, left) && !stop_ && seconds_since(start) < seconds) {
      std::optional<Question> next = source();
      if ((row.is_exhausted = !next)) break;
      questions.push_back(std::move(*next));
    }
    left -= questions.size();
    if (tell_) tell_(row.name);
    const double took = ask(questions);
    row.seconds += took;
    if (!most_) at_once = row.tally[Count::too_slow] > 0 ? 1 : next_number(questions.size(), took);
    for (std::size_t i = 0; i < replies_.size(); ++i) {
      if (!most_) questions[i].place->note_time(took / static_cast<double>(replies_.size()));
      take(questions[i], replies_[i], row);
      if (look && replies_[i].was_asked()) look(questions[i], replies_[i].answer);
    }
    if (answerer_->given_up() && !questions.empty()) leave(*questions.back().place, row);
    if (answerer_->is_hopeless()) break;
  }
  set_speed(row);
}

void Examination::take_over(const Examination& other) {
  for (const ExaminedRow& more : other.rows_) {
    ExaminedRow& its = add({.name = more.name, .explanation = more.explanation, .is_hard = more.is_hard});
    its.tally.add(more.tally);
    if (more.max_radii) its.max_radii = std::max(its.max_radii.value_or(0), *more.max_radii);
    its.seconds += more.seconds;
    its.scenes_given_up += more.scenes_given_up;
    if (its.last_failure.empty()) its.last_failure = more.last_failure;
    set_speed(its);
  }
  findings_.add(other.findings_);
  for (std::size_t i = 0; i < curves_.size(); ++i) curves_[i].add(other.curves_[i]);
  failed_ |= other.failed();
}

void Examination::leave(Place& place, ExaminedRow& row) const {
  if (place.is_given_up()) return;
  place.give_up();
  ++row.scenes_given_up;
  row.last_failure = last_fault_;
}

Judgement Examination::judgement_of(const Question& question, const Reply& reply) const {
  if (reply.is_fault()) return {Verdict::missing};
  return question::judgement_of(question, reply.answer, ulps_);
}

std::optional<Example> Examination::departing(const Question& question, const Reply& reply,
                                              const Judgement& judgement) const {
  auto diagnosis = diagnosis_of(question, reply.answer, judgement);
  if (!diagnosis) return std::nullopt;
  if (reply.origin == Origin::bad_line) diagnosis->cause = Cause::bad_line;
  return Example{question, reply.answer, judgement, *diagnosis, last_words_};
}

std::optional<Example> Examination::departing(const Question& question, const Reply& reply) const {
  return reply.was_asked() ? departing(question, reply, judgement_of(question, reply)) : std::nullopt;
}

void Examination::take(const Question& question, const Reply& reply, ExaminedRow& row) {
  if (!reply.was_asked()) {
    if (!is_over()) leave(*question.place, row);
    return;
  }
  const Judgement judgement = judgement_of(question, reply);
  if (reply.is_fault()) last_fault_ = reply.answer.message;
  const auto example = departing(question, reply, judgement);
  const bool is_nonsense = example && example->diagnosis.severity == Severity::nonsense;
  const bool is_slowness = silence_is_slowness_ && has_answered_ && reply.origin == Origin::silent;
  if (is_slowness)
    ++row.tally.counts[Count::too_slow], question.place->note_silence();
  else if (is_nonsense)
    ++row.tally.counts[Count::nonsense];
  else
    row.tally.count(judgement);
  if (on_judged_ && !is_nonsense) on_judged_(row.name, question, judgement);
  question.place->note(judgement.verdict == Verdict::unsupported);
  if (example) findings_.add(*example, row.name);
  const auto off = judgement.ulps ? question::radii_off(question, reply.answer) : std::nullopt;
  if (off) row.max_radii = std::max(row.max_radii.value_or(0), *off);
  if (!question.is_query() || is_slowness || row.tally.queries > kCompared) return;
  const Features features = features_of(
      question, names_obstacle(question.exact) ? std::optional(question.exact.obstacle) : std::nullopt);
  if (!example && judgement.verdict == Verdict::agree) findings_.add_right(features);
  const bool is_about_another = example && !judgement.wrong_time && example->diagnosis.by_radii;
  const double call = is_about_another ? *example->diagnosis.by_radii : features.depth;
  const double sizes[kMeasures.size()] = {call, features.distance, features.flight, features.start,
                                          features.radius};
  for (std::size_t i = 0; i < curves_.size(); ++i) curves_[i].add(sizes[i], judgement.verdict, off);
}

std::vector<Finding> Examination::findings() const {
  Asked asked;
  for (const ExaminedRow& row : rows_)
    asked[row.name] = {asked[row.name].number + row.asked() - row.tally[Count::unsupported], row.is_hard};
  return findings_.all(asked);
}

std::optional<Example> Examination::example_of(const Question& question) {
  answerer_->try_again();
  ask({question});
  if (replies_.empty()) return std::nullopt;
  return departing(question, replies_[0]);
}

Examination::Repeated Examination::repeat(const Question& question, std::size_t copies, Diagnosis like) {
  ask(std::vector<Question>(copies, question));
  Repeated repeated{{}, std::ranges::all_of(replies_, &Reply::was_asked)};
  for (std::size_t i = 0; i < replies_.size() && !repeated.failed; ++i) {
    const auto example = departing(question, replies_[i]);
    if (example && example->diagnosis.cause == like.cause && example->diagnosis.severity == like.severity)
      repeated.failed = i + 1;
  }
  return repeated;
}

}  // namespace lorentz::judge
