// Answers that are used again.
#include <catch2/catch.hpp>

#include <ostream>

#include <lorentz/answer.hpp>

using namespace lorentz;

// What makes an answer is not a property of one: `if (answer.hit)` was always true, `answer.error` printed 1.
template <auto make>
concept IsTaken = requires(std::ostream& out) {
  *make ? 1 : 0;
}
|| requires(std::ostream& out) {
  out << *make;
};
static_assert(!IsTaken<&Answer::hit> && !IsTaken<&Answer::inside> && !IsTaken<&Answer::never> &&
              !IsTaken<&Answer::later> && !IsTaken<&Answer::undecided> && !IsTaken<&Answer::error> &&
              !IsTaken<&Answer::unsupported_because>);

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
