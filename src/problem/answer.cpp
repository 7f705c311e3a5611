#include <lorentz/answer.hpp>

#include <cmath>

namespace lorentz {
namespace {

Answer with(Outcome outcome, ObstacleId obstacle = {}) {
  Answer answer;
  answer.outcome = outcome;
  answer.obstacle = std::move(obstacle);
  return answer;
}

}  // namespace

void Answer::clear() {
  outcome = Outcome::undecided;
  obstacle.lattice = obstacle.atom = 0;
  for (Integer& n : obstacle.cell) n = 0;
  time.reset();
  time_decimal.clear();
  exit_time.reset();
  detail.reset();
  message.clear();
  unsupported = false;
}

constinit const AnswerMaker<ObstacleId, double> Answer::hit{[](ObstacleId obstacle, double time) {
  Answer answer = with(Outcome::hit, std::move(obstacle));
  answer.time = time;
  return answer;
}};
constinit const AnswerMaker<ObstacleId> Answer::inside{
    [](ObstacleId obstacle) { return with(Outcome::inside, std::move(obstacle)); }};
constinit const AnswerMaker<> Answer::never{[] { return with(Outcome::never); }};
constinit const AnswerMaker<> Answer::later{[] { return with(Outcome::later); }};
constinit const AnswerMaker<> Answer::undecided{[] { return with(Outcome::undecided); }};
constinit const AnswerMaker<std::string> Answer::error{[](std::string message) {
  Answer answer = with(Outcome::error);
  answer.message = std::move(message);
  return answer;
}};
constinit const AnswerMaker<std::string> Answer::unsupported_because{[](std::string message) {
  Answer answer = error(std::move(message));
  answer.unsupported = true;
  return answer;
}};

Answer limited(Answer answer, double max_time) {
  const bool nothing_before = answer.outcome == Outcome::never || (answer.time && !(*answer.time < max_time));
  return max_time < HUGE_VAL && nothing_before ? Answer::later() : answer;
}

}  // namespace lorentz
