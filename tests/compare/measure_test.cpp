// What a tally says of the judgements that it counts, and the exact answers that they rest on.
#include "compare/measure.hpp"

#include <catch2/catch.hpp>

#include "compare/hard_cases.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using compare::Tally;
using oracle::Verdict;

TEST_CASE("A tally counts each verdict, and wrong times among those that agree", "[compare][measure]") {
  Tally tally;
  for (const Verdict verdict : {Verdict::agree, Verdict::ill_posed, Verdict::undecided, Verdict::unsupported,
                                Verdict::error, Verdict::missing, Verdict::wrong, Verdict::wrong})
    tally.count({verdict});
  tally.count({.verdict = Verdict::agree, .ulps = 9, .departs = 7, .wrong_time = true});
  CHECK(tally.queries == 9);
  for (const std::size_t once : {tally.ill_posed, tally.undecided, tally.unsupported, tally.error,
                                 tally.missing, tally.wrong_time, tally.timed_hits})
    CHECK(once == 1);
  CHECK(tally.wrong == 2);
  CHECK(tally.agree == 2);
  CHECK(tally.wrong_ulps == std::vector<double>{9});
  CHECK(tally.wrong_conditions == std::vector<double>{7});
  Tally twice = tally;
  twice.add(tally);
  CHECK((twice.queries == 18 && twice.agree == 4 && twice.wrong == 4 && twice.wrong_time == 2));
  CHECK((twice.timed_hits == 2 && twice.sum_ulp == 18 && twice.max_ulp == 9));
  CHECK(twice.wrong_ulps == std::vector<double>{9, 9});
}

TEST_CASE("Quantiles: the value that a share does not exceed", "[compare][measure]") {
  CHECK(compare::quantile({}, 0.5) == 0);
  CHECK(compare::quantile({3, 1, 2}, 0.5) == 2);
  CHECK(compare::quantile({3, 1, 2}, 0.99) == 3);
}

TEST_CASE("A tally's errors of times: the largest, the mean, and what a share of them does not exceed",
          "[compare][measure]") {
  Tally tally;
  CHECK(tally.mean_ulp() == 0);
  CHECK(tally.ulp_at(0.5) == 0);
  for (const double ulps : {3, 10, 1, 2, 9, 4, 8, 5, 7, 6})
    tally.count({.verdict = Verdict::agree, .ulps = ulps});
  tally.count({Verdict::agree});  // without a time
  CHECK(tally.timed_hits == 10);
  CHECK(tally.max_ulp == 10);
  CHECK(tally.mean_ulp() == 5.5);
  CHECK(tally.ulp_at(0) == 1);
  CHECK(tally.ulp_at(0.3) == 4);    // the nearest to 2.7 steps up from the first
  CHECK(tally.ulp_at(0.99) == 10);  // to 8.91
  CHECK(tally.ulp_at(1) == 10);
}

TEST_CASE("Exact answers are the same from the oracle and from certified, scenes mixed",
          "[compare][measure]") {
  constexpr std::uint64_t kSeed = 4711;
  const auto catalogue = test::all_scenes();
  compare::CaseSet set;
  std::vector<std::vector<Query>> queries;
  for (const char* name : {"square", "honeycomb", "cubic", "ellipsoids-mixed"}) {
    set.scenes.push_back(catalogue.at(name));
    const oracle::Oracle oracle(set.scenes.back());
    queries.push_back(
        compare::hard_queries(compare::Difficulty::grazing, set.scenes.back(), oracle, kSeed, 100));
    // Tangent to discs on both sides, along a lattice vector; and an obstacle left that no column can name.
    queries.back().push_back({{0.25, 0.5, 0}, {1, 0, 0}, {}});
    const Integer far = *Integer::from_decimal("100000000000000000000");
    queries.back().push_back({queries.back()[0].x, {1, 0.25, 0}, ObstacleId{0, 0, {far, 0, 0}}});
  }
  for (std::size_t i = 0; i < queries[0].size(); ++i)
    for (std::size_t scene = 0; scene < queries.size(); ++scene)
      set.cases.push_back({"null", scene, queries[scene][i]});
  const auto exact = compare::exact_answers(set),
             certified = compare::exact_answers(set, {}, compare::Truth::certified);
  REQUIRE(exact.size() == set.cases.size());
  REQUIRE(certified.size() == set.cases.size());
  std::map<Outcome, int> met;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    INFO(test::stream(set.scenes[set.cases[i].scene], set.cases[i].query) << "seed " << kSeed);
    ++met[exact[i].outcome];
    CHECK(test::same(exact[i], certified[i]));
  }
  CHECK(met[Outcome::hit] > 380);
  CHECK(met[Outcome::never] + met[Outcome::inside] > 0);
}

TEST_CASE("Of each name as many cases are asked as it is to be asked, in each round, and judged once",
          "[compare][measure]") {
  compare::CaseSet set;
  set.scenes = {unit_scene(2, 0.25), unit_scene(3, 0.25)};
  for (std::size_t i = 0; i < 40; ++i)
    set.cases.push_back({"null", i / 20, {{0.5, 0.5, 0.5}, {1, 1, 1}, {}}});
  for (std::size_t i = 0; i < 20; ++i) set.cases[i].query = {{0.5, 0.5, 0}, {1, 1, 0}, {}};
  const auto exact = compare::exact_answers(set);
  compare::MeasureOptions options;
  options.rounds = 2;
  options.counts = {0, 17, 30, 99};
  std::vector<std::size_t> judged(4);
  std::map<std::string, std::size_t> asked;
  options.on_judged = [&](std::size_t name, std::size_t, const oracle::Judgement&) { ++judged[name]; };
  options.listener.progress = [&](const std::string& name, std::size_t done, std::size_t total) {
    if (done == total) asked[name] += done;
  };
  const auto tallies = compare::measure(
      set, exact, compare::engines_named({"oracle", "reduction", "batch", "walk"}), {}, options);
  REQUIRE(tallies.size() == 4);
  const std::size_t counts[] = {0, 17, 30, 40};
  for (std::size_t i = 0; i < 4; ++i) {
    INFO(tallies[i].name);
    CHECK((tallies[i].queries == counts[i] && tallies[i].agree == counts[i] && judged[i] == counts[i]));
    CHECK(asked[tallies[i].name] == 2 * counts[i]);
    for (const double ns : {tallies[i].ns_per_query, tallies[i].ns_median, tallies[i].ns_low})
      CHECK((counts[i] > 0 ? ns > 0 : ns == 0));
  }
  options.rounds = 0;
  for (const auto& tally : compare::measure(
           set, exact, compare::engines_named({"oracle", "batch", "walk", "published"}), {}, options))
    CHECK((tally.queries == 0 && tally.ns_per_query == 0));
}
