#include "question/examine.hpp"

#include <cmath>
#include <deque>
#include <limits>
#include <mutex>

#include "src/problem/same_answer.hpp"
#include "src/problem/threads.hpp"

namespace lorentz::question {
namespace {

using oracle::Judgement;
using oracle::Verdict;

Judgement judgement_of_invalid(const Answer& given) {
  if (given.outcome == Outcome::undecided) return {Verdict::undecided};
  if (given.outcome == Outcome::error) return {given.unsupported ? Verdict::unsupported : Verdict::agree};
  return {Verdict::wrong, {}, std::numeric_limits<double>::infinity()};
}

// The limit is the hit's time, within the tolerance of times; of ulps if times are not judged.
bool is_at_limit(const Question& question, double ulps) {
  const Answer& exact = question.exact;
  if (exact.outcome != Outcome::hit || ulps == 0) return false;
  const Answer there = Answer::hit(exact.obstacle, question.max_time);
  const Place& place = *question.place;
  Claim claim = place.claim();
  const auto is_right = [&](const oracle::Judge& judge) {
    return !judge.judge(question.query, exact, there, ulps).wrong_time;
  };
  if (!std::isinf(claim.time_tolerance.value_or(0))) return is_right(place.judge());
  claim.time_tolerance.reset();
  return is_right(oracle::Judge(place.scene(), claim));
}

}  // namespace

bool is_later(const Question& question) {
  const Answer& exact = question.exact;
  if (exact.outcome != Outcome::hit) return exact.outcome == Outcome::never;
  // The exact time lies between the neighbours of the rounded time, which therefore decides all other limits.
  if (*exact.time != question.max_time) return question.max_time < *exact.time;
  return question.place->exact(question.query, {.max_time = question.max_time}).outcome == Outcome::later;
}

Judgement judgement_of(const Question& question, const Answer& given, double ulps, AtLimit at_limit) {
  if (!question.is_query()) return judgement_of_invalid(given);
  if (question.has_limit()) {
    const bool says_later = given.outcome == Outcome::later || given.outcome == Outcome::never;
    if (says_later && is_later(question)) return {Verdict::agree};
    if (says_later && at_limit == AtLimit::excused && is_at_limit(question, ulps))
      return {Verdict::ill_posed};
    if (says_later || (names_obstacle(given) && at_limit == AtLimit::exact && is_later(question)))
      return {Verdict::wrong, {}, std::numeric_limits<double>::infinity()};
  }
  // Equal answers without exits need no judge, nor do those that say nothing, and many scenes never get one.
  const Answer& exact = question.exact;
  if (given.outcome == Outcome::undecided && exact.outcome != Outcome::error) return {Verdict::undecided};
  const bool may_agree =
      given.outcome == Outcome::hit || given.outcome == Outcome::never ||
      (given.outcome == Outcome::inside && question.place->claim().inside == StartInside::inside);
  if (may_agree && !given.exit_time && same_answer(given, exact)) {
    Judgement agrees{Verdict::agree};
    if (exact.time && std::isfinite(*exact.time)) agrees.ulps = 0;
    return agrees;
  }
  return question.place->judge().judge(question.query, exact, given, ulps);
}

bool departs(const Judgement& judgement) {
  return judgement.wrong_time || judgement.verdict == Verdict::wrong ||
         judgement.verdict == Verdict::ill_posed;
}

void ask(Answerer& answerer, const Question& question) {
  if (!question.is_query())
    answerer.ask_text(question.id, question.text);
  else if (question.has_limit())
    answerer.ask_until(question.id, question.query, question.max_time);
  else
    answerer.ask(question.id, question.query);
}

void ask_all(const Source& source, Answerer& answerer,
             const std::function<void(const Question&, Reply&)>& take) {
  std::deque<Question> open;
  std::size_t answered = 0;  // of the open ones: a question stays until it is asked
  answerer.on_reply([&](Reply& reply) { take(open[answered++], reply); });
  std::shared_ptr<Place> place;
  while (std::optional<Question> next = source()) {
    if (next->place != place && !answerer.is_in(next->place->scene()))
      answerer.set_scene(next->place->scene());
    place = next->place;
    open.push_back(std::move(*next));
    ask(answerer, open.back());
    for (; answered > 0; --answered) open.pop_front();
  }
  answerer.drain();
  answerer.on_reply([](Reply&) {});
}

Judgement judgement_of(const Question& question, const Reply& reply, double ulps) {
  if (!reply.was_asked() || reply.is_fault()) return {Verdict::missing};
  return judgement_of(question, reply.answer, ulps);
}

void examine(const Source& source, Answerer& answerer, double ulps, const Sink& sink) {
  ask_all(source, answerer, [&](const Question& question, const Reply& reply) {
    sink({question, reply, judgement_of(question, reply, ulps)});
  });
}

void in_stretches(std::size_t count, std::size_t jobs,
                  const std::function<void(std::size_t job, std::size_t begin, std::size_t end)>& act) {
  const auto bound = [&](std::size_t job) { return job * count / jobs; };
  std::vector<std::future<void>> others;
  for (std::size_t job = 1; job < jobs; ++job)
    others.push_back(std::async(kInThreadIfPossible, [&, job] { act(job, bound(job), bound(job + 1)); }));
  act(0, bound(0), bound(1));
  for (std::future<void>& other : others) other.get();
}

void answer_exactly(std::span<Question> questions, const Listener& listener, int jobs) {
  for (const Question& question : questions)
    question.place->oracle();  // made here, because threads may only read it
  std::mutex mutex;
  std::size_t done = 0;
  in_stretches(questions.size(), static_cast<std::size_t>(jobs),
               [&](std::size_t, std::size_t begin, std::size_t end) {
                 for (Question& question : questions.subspan(begin, end - begin)) {
                   question.exact = question.place->exact(question.query);
                   const std::lock_guard lock(mutex);
                   report(listener, "exact answers", ++done, questions.size());
                 }
               });
}

}  // namespace lorentz::question
