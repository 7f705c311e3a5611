#include "compare/examine.hpp"

#include <algorithm>
#include <deque>
#include <future>
#include <limits>
#include <mutex>

namespace lorentz::compare {
namespace {

using oracle::Judgement;
using oracle::Verdict;

Judgement judgement_of_invalid(const Answer& given) {
  if (given.outcome == Outcome::undecided) return {Verdict::undecided};
  if (given.outcome == Outcome::error) return {given.unsupported ? Verdict::unsupported : Verdict::agree};
  return {Verdict::wrong, {}, std::numeric_limits<double>::infinity()};
}

}  // namespace

Judgement judgement_of(const Question& question, const Answer& given, double ulps) {
  if (!question.is_query()) return judgement_of_invalid(given);
  return question.place->judge().judge(question.query, question.exact, given, ulps);
}

bool departs(const Judgement& judgement) {
  return judgement.wrong_time || judgement.verdict == Verdict::wrong ||
         judgement.verdict == Verdict::ill_posed;
}

void examine(const Source& source, Answerer& answerer, double ulps, const Sink& sink) {
  std::deque<Question> open;
  answerer.on_answer([&](Answer& given) {
    const Question question = std::move(open.front());
    open.pop_front();
    const bool was_asked = answerer.origin() != Answerer::Origin::not_asked;
    sink({question, given, answerer.origin(), was_asked ? judgement_of(question, given, ulps) : Judgement()});
  });
  std::shared_ptr<Place> place;
  while (std::optional<Question> next = source()) {
    if (next->place != place) answerer.set_scene((place = next->place)->scene());
    open.push_back(std::move(*next));
    const Id id = open.back().id;  // its answer may come at once, and take it away
    if (open.back().is_query()) {
      const Query query = open.back().query;
      answerer.ask(id, query);
    } else {
      const std::string text = open.back().text;
      answerer.ask_text(id, text);
    }
  }
  answerer.drain();
  answerer.on_answer([](Answer&) {});
}

namespace {

// Cuts [0, count) into one stretch per job and calls act(job, begin, end) for each in a thread of its own.
template <class Act>
void in_stretches(std::size_t count, std::size_t jobs, const Act& act) {
  const auto bound = [&](std::size_t job) { return job * count / jobs; };
  std::vector<std::future<void>> others;
  for (std::size_t job = 1; job < jobs; ++job)
    others.push_back(std::async(std::launch::async, [&, job] { act(job, bound(job), bound(job + 1)); }));
  act(0, bound(0), bound(1));
  for (std::future<void>& other : others) other.get();
}

}  // namespace

void examine(std::span<const Question> questions, std::span<const std::unique_ptr<Answerer>> answerers,
             double ulps, const Sink& sink) {
  if (answerers.size() == 1) return examine(all_of(questions), *answerers[0], ulps, sink);
  for (const Question& question : questions)
    question.place->judge();  // made here, for threads may only read it
  struct Came {
    Answer given;
    Answerer::Origin origin{};
    Judgement judgement;
  };
  std::vector<Came> came(questions.size());
  in_stretches(questions.size(), answerers.size(), [&](std::size_t job, std::size_t begin, std::size_t end) {
    std::size_t next = begin;
    examine(all_of(questions.subspan(begin, end - begin)), *answerers[job], ulps, [&](const Judged& judged) {
      came[next++] = {judged.given, judged.origin, judged.judgement};
    });
  });
  for (std::size_t i = 0; i < questions.size(); ++i)
    sink({questions[i], came[i].given, came[i].origin, came[i].judgement});
}

namespace {

constexpr const char* kExactAnswers = "exact answers";

// In the order of places, so that each batch engine is prepared once.
void answer_by_certified(std::span<Question> questions, const Listener& listener, int jobs) {
  std::vector<Question*> order;
  for (Question& question : questions) order.push_back(&question);
  std::stable_sort(order.begin(), order.end(),
                   [](const Question* a, const Question* b) { return a->place < b->place; });
  std::size_t told = 0;
  AnswererOptions options;
  options.jobs = jobs;
  const auto certified = engine_named("certified-batch").answerer(options);
  certified->on_answer([&](Answer& answer) {
    order[told++]->exact = std::move(answer);
    report(listener, kExactAnswers, told, order.size());
  });
  const Place* place = nullptr;
  for (const Question* question : order) {
    if (question->place.get() != place) certified->set_scene((place = question->place.get())->scene());
    certified->ask(question->id, question->query);
  }
  certified->finish();
}

}  // namespace

void answer_exactly(std::span<Question> questions, Truth truth, const Listener& listener, int jobs) {
  if (truth == Truth::certified) return answer_by_certified(questions, listener, jobs);
  for (const Question& question : questions) question.place->oracle();  // made here, too
  std::mutex mutex;
  std::size_t done = 0;
  in_stretches(questions.size(), static_cast<std::size_t>(jobs),
               [&](std::size_t, std::size_t begin, std::size_t end) {
                 for (Question& question : questions.subspan(begin, end - begin)) {
                   question.exact = question.place->oracle().first_hit(question.query);
                   const std::lock_guard lock(mutex);
                   report(listener, kExactAnswers, ++done, questions.size());
                 }
               });
}

}  // namespace lorentz::compare
