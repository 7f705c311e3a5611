#include <lorentz/certified.hpp>

#include <limits>

namespace lorentz::oracle {

Certified::Certified(const Scene& scene) : scene_(scene), oracle_(scene) {
  if (!Reduction::beyond(scene)) fast_.emplace(scene);
}

Answer Certified::first_hit(const Query& query, const Request& request, StageTally* tally) const {
  Answer answer;
  first_hit(query, request, answer, tally);
  return answer;
}

void Certified::first_hit(const Query& query, const Request& request, Answer& answer,
                          StageTally* tally) const {
  answer.clear();
  if (fast_ && request.digits == 0 && !request.detail && answer_fast(query, request, answer, tally)) return;
  if (tally) tally->count(Stage::undecided);
  answer = oracle_.first_hit(query, request);
}

// Gives the fast engine's answer. Returns false if the engine does not know it, or does not know the time to
// the last bit.
bool Certified::answer_fast(const Query& query, const Request& request, Answer& answer,
                            StageTally* tally) const {
  const double max_time = request.max_time.value_or(std::numeric_limits<double>::infinity());
  if (auto flaw = flaw_of(query, scene_, max_time)) {
    answer = Answer::error(*flaw);
    return true;
  }
  std::array<WideInteger, 3> cell{};
  const Flight flight = fast_->fly(query, max_time, Reduction::Time::rounded, &cell);
  if (flight.outcome == Outcome::undecided) return false;
  if (flight.outcome == Outcome::inside && request.start != StartInside::inside) return false;
  if (flight.outcome == Outcome::hit && !flight.time_is_rounded) return false;
  set_answer(flight, cell, answer);
  if (tally) tally->count(flight.stage);
  return true;
}

}  // namespace lorentz::oracle
