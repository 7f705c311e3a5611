#include <lorentz/answer.hpp>

#include <cmath>

namespace lorentz {

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
  return {.outcome = Outcome::hit, .obstacle = std::move(obstacle), .time = time};
}

Answer Answer::inside(ObstacleId obstacle) {
  return {.outcome = Outcome::inside, .obstacle = std::move(obstacle)};
}

Answer Answer::never() {
  return {.outcome = Outcome::never};
}

Answer Answer::later() {
  return {.outcome = Outcome::later};
}

Answer Answer::undecided() {
  return {};
}

Answer Answer::error(std::string message) {
  Answer answer{.outcome = Outcome::error};
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
