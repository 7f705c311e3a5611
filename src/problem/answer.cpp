#include <lorentz/answer.hpp>

#include <cmath>

namespace lorentz {
namespace {

Answer with(Outcome outcome) {
  Answer answer;
  answer.outcome = outcome;
  return answer;
}

}  // namespace

void Answer::clear() {
  outcome = Outcome::undecided;
  obstacle.lattice = obstacle.atom = 0;
  for (Integer& n : obstacle.cell) n = 0;
  time.reset();
  time_decimal.clear();
  detail.reset();
  message.clear();
  unsupported = false;
}

Answer Answer::hit(ObstacleId obstacle, double time) {
  Answer answer = with(Outcome::hit);
  answer.obstacle = std::move(obstacle);
  answer.time = time;
  return answer;
}

Answer Answer::inside(ObstacleId obstacle) {
  Answer answer = with(Outcome::inside);
  answer.obstacle = std::move(obstacle);
  return answer;
}

Answer Answer::never() {
  return with(Outcome::never);
}

Answer Answer::later() {
  return with(Outcome::later);
}

Answer Answer::undecided() {
  return with(Outcome::undecided);
}

Answer Answer::error(std::string message) {
  Answer answer = with(Outcome::error);
  answer.message = std::move(message);
  return answer;
}

Answer Answer::unsupported_because(std::string message) {
  Answer answer = error(std::move(message));
  answer.unsupported = true;
  return answer;
}

Answer limited(Answer answer, double max_time) {
  const bool nothing_before = answer.outcome == Outcome::never || (answer.time && !(*answer.time < max_time));
  return std::isfinite(max_time) && nothing_before ? Answer::later() : answer;
}

}  // namespace lorentz
