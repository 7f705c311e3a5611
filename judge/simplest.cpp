#include "judge/simplest.hpp"

#include <algorithm>
#include <chrono>

#include <lorentz/geometry.hpp>
#include "fuzz/campaign/shrink.hpp"

namespace lorentz::judge {
namespace {

bool is_alike(Example& a, const Example& b, const Finding& finding) {
  if (finding.by_radii && a.diagnosis.by_radii > finding.by_radii) return false;
  a.features = features_in(a);
  if (!finding.is_about(a)) return false;
  return a.diagnosis.cause == b.diagnosis.cause && a.diagnosis.severity == b.diagnosis.severity &&
         a.given.outcome == b.given.outcome && a.question.exact.outcome == b.question.exact.outcome;
}

// The limit of a simpler flight is as near to its end.
double limit_like(const Question& question, const Answer& exact) {
  const double before = question.exact.time.value_or(0), factor = exact.time.value_or(before) / before;
  if (!question.has_limit() || !(factor > 0)) return question.max_time;
  const double limit = rounded(question.max_time * factor, question.place->claim().precision);
  return limit > 0 ? limit : question.max_time;
}

}  // namespace

// A program that gives no answer is not asked thousands of times, because it would be given up.
Example simplest(const Finding& finding, TimedExamination& examination, double seconds) {
  using Clock = std::chrono::steady_clock;
  const Example& example = finding.simplest;
  const Cause cause = example.diagnosis.cause;
  if (!example.question.is_query() || cause == Cause::no_answer || cause == Cause::bad_line) return example;
  const auto start = Clock::now();
  std::optional<Example> last;
  const fuzz::StillFails same = fuzz::in_places(
      [&](const Scene& scene) { return std::make_shared<Place>(scene, examination.order().claim); },
      [&](const std::shared_ptr<Place>& place, const Query& query) {
        const Answer exact = place->exact(query);
        if (!place->takes(query, exact)) return false;
        last = example_of({.place = place,
                           .query = query,
                           .exact = exact,
                           .where = example.question.where,
                           .max_time = limit_like(example.question, exact)},
                          examination);
        return last && is_alike(*last, example, finding);
      });
  const auto flight = [&] {
    const Question& question = last->question;
    return question.exact.time ? *question.exact.time * length(question.query.v) : -1;
  };
  const Scene& scene = example.question.place->scene();
  if (examination.is_over() || !same(scene, example.question.query)) return example;
  const auto is_up = [&] {
    return examination.is_over() || std::chrono::duration<double>(Clock::now() - start).count() > seconds;
  };
  const fuzz::Shrunk shrunk =
      fuzz::shrink(scene, example.question.query, same, flight, {fuzz::kShrinkTries, is_up});
  return same(shrunk.scene, shrunk.query) ? *last : example;
}

std::optional<Example> example_of(const Question& question, TimedExamination& examination) {
  const auto examples = examination.examples_of({&question, 1});
  return examples.empty() ? std::nullopt : examples[0];
}

std::optional<std::size_t> failed_copy(const Question& question, std::size_t copies, Diagnosis like,
                                       TimedExamination& examination, bool& all_answered) {
  const std::vector<std::optional<Example>> examples =
      examination.examples_of(std::vector<Question>(copies, question));
  all_answered = examples.size() == copies;
  const auto failed = std::ranges::find_if(examples, [&](const auto& example) {
    return example && example->diagnosis.cause == like.cause && example->diagnosis.severity == like.severity;
  });
  return failed == examples.end() ? std::nullopt : std::optional<std::size_t>(failed - examples.begin() + 1);
}

void recheck(Finding& finding, const std::function<std::unique_ptr<TimedExamination>()>& start,
             double seconds) {
  const Example& example = finding.simplest;
  finding.recheck = Recheck::no_time;
  for (const std::size_t copies : {std::size_t{1}, kMostRepetitions}) {
    const std::unique_ptr<TimedExamination> anew = start();
    anew->limit(seconds);
    bool all_answered = false;
    const auto failed = failed_copy(example.question, copies, example.diagnosis, *anew, all_answered);
    anew->finish();
    if (failed) {
      finding.recheck = Recheck::fails;
      finding.repetitions = *failed;
    }
    if (failed || !all_answered) return;
  }
  finding.recheck = Recheck::passes;
}

}  // namespace lorentz::judge
