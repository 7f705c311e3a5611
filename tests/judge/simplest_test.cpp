// The simplest case of a finding goes wrong in the finding's own way.
#include "judge/simplest.hpp"

#include <catch2/catch.hpp>
#include <map>

#include <lorentz/geometry.hpp>
#include "fuzz/campaign/shrink.hpp"
#include "tests/judge/judge_support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using namespace lorentz::judge;

TEST_CASE("The simplest case is simpler, of the same cause, and no deeper than what was met",
          "[judge][simplest]") {
  // `published` may pass over a disc on its way from one: here over (1, 1), which the line enters by 0.018
  // radii.
  const std::atomic<bool> stop = false;
  TimedExamination examination(order_of(question::engine_named("published")), {}, stop);
  const auto place = std::make_shared<Place>(unit_scene(2, 0.5));
  const Query query{{-0.25, 0, 0}, {2, 0.7601234567, 0}, ObstacleId{0, 0, {0, 0, 0}}};
  const auto example = example_of({place, query, place->oracle().first_hit(query), "here", ""}, examination);
  REQUIRE(example);
  REQUIRE(example->diagnosis.by_radii);
  Finding finding{*example, "here", 1, example->diagnosis.by_radii};
  constexpr double kSeconds = 60;  // the shrinker ends by its number of tries
  const Example kept = simplest(finding, examination, kSeconds);
  CHECK(kept.diagnosis.cause == example->diagnosis.cause);
  CHECK(kept.diagnosis.by_radii <= finding.by_radii);
  CHECK(kept.question.query.v[1] != query.v[1]);

  finding.by_radii = 1;  // others were met deeper
  const Example free = simplest(finding, examination, kSeconds);
  CHECK(free.diagnosis.cause == example->diagnosis.cause);
  CHECK(free.diagnosis.by_radii > example->diagnosis.by_radii);
}

TEST_CASE("The simplest case keeps the cause, where simpler ones go wrong in another way",
          "[judge][simplest]") {
  // In binary32 most times are off so far that they count as another quantity; few discs are passed over.
  const std::atomic<bool> stop = false;
  TimedExamination examination(order_of(question::engine_named("published-float")), {}, stop);
  const auto place = std::make_shared<Place>(unit_scene(2, 0.01));
  constexpr std::uint64_t kSeed = 20161115;
  std::map<Cause, Example> met;
  for (const Query& query : starts::free_starts(place->scene(), starts::Kind::uniform, kSeed, 300))
    if (const auto example =
            example_of({place, query, place->oracle().first_hit(query), "here", ""}, examination))
      met.try_emplace(example->diagnosis.cause, *example);
  REQUIRE(met.contains(Cause::passed_over));
  REQUIRE(met.contains(Cause::not_the_time));
  const Example& example = met.at(Cause::passed_over);
  const Example kept = simplest({example, "here", 1, 1e300}, examination, 60);
  CHECK(kept.diagnosis.cause == Cause::passed_over);
  CHECK(fuzz::complexity(kept.question.place->scene(), kept.question.query) <
        fuzz::complexity(place->scene(), example.question.query));
}

TEST_CASE("The simplest case keeps its limit, as near to the hit", "[judge][simplest]") {
  // It compares the limit with the length of the flight instead of its time.
  const auto engine =
      guest("by length", [](const Scene&, const Query& query, double max_time, Answer& answer) {
        if (answer.time && *answer.time * length(query.v) > max_time) answer = Answer::later();
      });
  const std::atomic<bool> stop = false;
  TimedExamination examination(order_of(engine), {}, stop);
  const auto place = std::make_shared<Place>(unit_scene(2, 0.25));
  const Query query{{0.4375 + 0x1p-20, 0.0625, 0}, {3.25 + 0x1p-20, 0.125, 0}, {}};
  const Answer exact = place->exact(query);
  const auto example = example_of(
      {.place = place, .query = query, .exact = exact, .where = "here", .max_time = 2 * *exact.time},
      examination);
  REQUIRE(example);
  REQUIRE(example->diagnosis.cause == Cause::later_for_hit);
  const Example kept = simplest({*example, "here", 1, {}}, examination, 60);
  CHECK(kept.diagnosis.cause == Cause::later_for_hit);
  CHECK(kept.question.max_time == Approx(2 * *kept.question.exact.time));
  CHECK(fuzz::complexity(kept.question.place->scene(), kept.question.query) <
        fuzz::complexity(place->scene(), query));
}
