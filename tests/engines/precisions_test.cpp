// The published algorithm in other number types than binary64.
#include "question/precisions/precisions.hpp"

#include <catch2/catch.hpp>

#include <lorentz/verdict.hpp>
#include "question/examine.hpp"
#include "question/precisions/big_number.hpp"
#include "question/precisions/published_in.hpp"
#include "question/starts/free_starts.hpp"
#include "question/tally.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::question;
using namespace lorentz::test;

// The generic search is the published one: only the number type is another, so the types are what precisions
// differ by. 53 bits rounded to nearest, by other code than the processor's.
TEST_CASE("In 53 bits of any library the search is `published`, bit by bit", "[engines][precisions]") {
  int hits = 0, leaving = 0;
  for (const auto& [dimension, r, count] :
       {std::tuple{2, 0.3, 150u}, {2, 0.1, 150u}, {2, 1e-5, 60u}, {3, 0.2, 60u}, {3, 0.05, 20u}}) {
    const Scene scene = unit_scene(dimension, r);
    const oracle::Oracle oracle(scene);
    const PublishedIn<BigNumber<53>> other(scene);
    for (Query query : starts::free_starts(scene, starts::Kind::uniform, 20161115, count)) {
      for (int flight = 0; flight < 2; ++flight) {
        const Answer published = make_engine("published", scene)->first_hit(query);
        INFO("r = " << r);
        REQUIRE(same(published, other.first_hit(query)));
        if (published.outcome != Outcome::hit) break;
        ++hits, leaving += flight;
        for (int i = 0; i < dimension; ++i) query.x[i] += *published.time * query.v[i];
        query.from = published.obstacle;
        std::swap(query.v[0], query.v[1]);
      }
    }
  }
  CHECK(hits > 600);
  CHECK(leaving > 300);
}

TEST_CASE("What grazes at r = 1e-6 is beyond 24 bits and 53, and not beyond 256", "[engines][precisions]") {
  const Scene scene = unit_scene(2, 1e-6);
  const auto place = std::make_shared<Place>(scene);
  std::vector<Question> questions =
      questions_of(place, starts::free_starts(scene, starts::Kind::grazing, 20161115, 60));
  answer_exactly(questions);
  std::vector<Tally> tallies;
  for (const EngineInfo& engine : engines_named({"published-float", "published", "published-256"})) {
    Tally& tally = tallies.emplace_back();
    tally.name = engine.name;
    examine(all_of(questions), *engine.answerer({}), oracle::kDefaultUlps,
            [&](const Judged& judged) { tally.count(judged.judgement); });
  }
  CHECK(tallies[0][question::Count::wrong] > 40);  // 48 seen
  CHECK(tallies[1][question::Count::wrong] == 0);
  CHECK(tallies[1][question::Count::ill_posed] > 8);
  CHECK(tallies[1][question::Count::wrong_time] > 20);
  CHECK(tallies[2][question::Count::agree] == 60);
  CHECK(tallies[2].max_ulp() == 0);  // times are rounded rightly
}

TEST_CASE("Precisions know their limits", "[engines][precisions]") {
  const Query query{{0, 0.3, 0}, {1, 0.7548776662466927e-4, 0}, {}};
  const Scene tiny = unit_scene(2, 1e-22);
  const Answer exact = oracle::Oracle(tiny).first_hit(query);
  REQUIRE_FALSE(exact.obstacle.cell[0].fits_int64());
  for (const std::string& name : precision_names()) {
    INFO(name);
    const auto engine = make_precision(name, unit_scene(2, 0.25));
    CHECK(engine->first_hit({{0.5, 0.5, 0}, {1, 1, 0}, {}}).obstacle.cell == Cell{1, 1, 0});
    CHECK(engine->first_hit({{0x1p51, 0.5, 0}, {1, 1, 0}, {}}).unsupported);
    CHECK(engine->first_hit({{0.5, 0.5, 0}, {1, 0, 0}, {}}).unsupported);
    CHECK(make_precision(name, unit_scene(2, 0.6))->first_hit(query).unsupported);
    // Columns beyond 2^63: so far only 256 bits see; binary32 is to say something, or that it gave up.
    const Answer answer = make_precision(name, tiny)->first_hit(query);
    if (name == "published-256") CHECK(same_obstacle(answer, exact));
    CHECK((!answer.time || std::isfinite(*answer.time)));
    // Slopes that binary32 does not hold, and whose inverse overflows there.
    for (const double slope : {0x1p-127, 0x1p-140, 0x1p-160})
      CHECK(make_precision(name, unit_scene(2, 0.4))->first_hit({{0.5, 0.9, 0}, {1, slope, 0}, {}}).outcome !=
            Outcome::never);
  }
  CHECK(make_precision("published-53", unit_scene(2, 0.1)) == nullptr);
}
