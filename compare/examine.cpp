#include "compare/examine.hpp"

#include <algorithm>
#include <deque>
#include <limits>

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

constexpr const char* kExactAnswers = "exact answers";

// Place by place: that of a batch is prepared once.
void ask_certified(std::span<Question> questions, const Listener& listener) {
  std::vector<Question*> order;
  for (Question& question : questions) order.push_back(&question);
  std::stable_sort(order.begin(), order.end(),
                   [](const Question* a, const Question* b) { return a->place < b->place; });
  std::size_t told = 0;
  const auto certified = engine_named("certified-batch").answerer({});
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

void answer_exactly(std::span<Question> questions, Truth truth, const Listener& listener) {
  if (truth == Truth::certified) return ask_certified(questions, listener);
  std::size_t done = 0;
  for (Question& question : questions) {
    question.exact = question.place->oracle().first_hit(question.query);
    report(listener, kExactAnswers, ++done, questions.size());
  }
}

}  // namespace lorentz::compare
