// Answers that are used again.
#include <catch2/catch.hpp>

#include <lorentz/answer.hpp>

using namespace lorentz;

TEST_CASE("Nothing is left of an answer that is cleared") {
  Answer answer = Answer::hit({1, 2, {3, *Integer::from_decimal("-99999999999999999999"), 5}}, 0.5);
  answer.time_decimal = "0.5";
  answer.detail.emplace();
  answer.message = "no";
  answer.unsupported = true;
  answer.clear();
  CHECK(answer.outcome == Outcome::undecided);
  CHECK(answer.obstacle == ObstacleId{});
  CHECK_FALSE(answer.time);
  CHECK(answer.time_decimal.empty());
  CHECK_FALSE(answer.detail);
  CHECK(answer.message.empty());
  CHECK_FALSE(answer.unsupported);
}
