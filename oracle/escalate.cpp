#include "escalate.hpp"

#include <limits>

namespace lorentz::oracle {

Certified::Certified(const Scene& scene) : scene_(scene), oracle_(scene) {
  if (!Reduction::beyond(scene)) fast_.emplace(scene);
}

Answer Certified::first_hit(const Query& query, const Request& request, StageTally* tally) const {
  if (fast_ && request.digits == 0 && !request.detail)
    if (auto answer = fast_answer(query, request, tally)) return std::move(*answer);
  if (tally) tally->count(Stage::undecided);
  return oracle_.first_hit(query, request);
}

// The fast engine's answer, or nothing if it does not know it, or does not know the time to the last bit.
std::optional<Answer> Certified::fast_answer(const Query& query, const Request& request,
                                             StageTally* tally) const {
  if (auto flaw = flaw_of(query, scene_)) return Answer::error(*flaw);
  const double max_time = request.max_time.value_or(std::numeric_limits<double>::infinity());
  const Flight flight = fast_->fly(query, max_time, Reduction::Time::rounded);
  if (flight.outcome == Outcome::undecided) return std::nullopt;
  Answer answer = answer_of(flight);
  if (flight.outcome == Outcome::hit) {
    // Rounding keeps order: beside a time that is rounded to the limit itself nothing is known.
    if (!flight.time_is_rounded || flight.time == max_time) return std::nullopt;
    if (flight.time > max_time) answer = Answer::later();
  }
  if (flight.outcome == Outcome::never && request.max_time) answer = Answer::later();
  if (tally) tally->count(flight.stage);
  return answer;
}

}  // namespace lorentz::oracle
