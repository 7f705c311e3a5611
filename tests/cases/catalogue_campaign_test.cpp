// Every scene of the catalogue: `certified` gives the oracle's answers, `walk` and `classical` agree where
// they can go, and the mean free path is Santalo's.
#include <catch2/catch.hpp>

#include <cmath>

#include <lorentz/certified.hpp>
#include <lorentz/engine.hpp>
#include <lorentz/reduction.hpp>
#include <lorentz/scene_check.hpp>
#include <lorentz/walk.hpp>
#include "question/starts/free_starts.hpp"
#include "src/problem/scene_geometry.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using starts::Kind;

namespace {

constexpr Kind kDifficulties[] = {Kind::uniform, Kind::near_rational, Kind::grazing};

std::vector<Query> queries_of(const Scene& scene, Kind difficulty, std::uint64_t seed, std::size_t count) {
  return starts::free_starts(scene, difficulty, seed, count);
}

// `certified` against the oracle; how many queries the fast engine decided, in `tally`.
void hold_certified(const Scene& scene, Kind difficulty, std::size_t count, StageTally& tally) {
  const oracle::Certified certified(scene);
  const oracle::Oracle exact(scene);
  for (const Query& query : queries_of(scene, difficulty, 4, count)) {
    INFO(stream(scene, query));
    REQUIRE(same(certified.first_hit(query, {}, &tally), exact.first_hit(query)));
  }
}

bool overlaps(const Scene& scene) {
  for (const oracle::Contact& contact : oracle::contacts_in(scene, 100).found)
    if (contact.overlap) return true;
  return false;
}

}  // namespace

TEST_CASE("certified equals the oracle on every scene of the catalogue", "[cases][catalogue_campaign]") {
  for (const auto& [name, scene] : all_scenes())
    for (const Kind difficulty : kDifficulties) {
      CAPTURE(name, name_of(difficulty));
      StageTally tally;
      hold_certified(scene, difficulty, 300, tally);
      // Drawn queries are the fast engine's, unless obstacles overlap their own translates.
      if (difficulty == Kind::uniform && !Reduction::beyond(scene)) CHECK(tally.undecided < 3);  // 0 seen
    }
}

TEST_CASE("The oracle equals walk on every scene of the catalogue", "[cases][catalogue_campaign]") {
  for (const auto& [name, scene] : all_scenes())
    for (const Kind difficulty : kDifficulties) {
      CAPTURE(name, name_of(difficulty));
      const oracle::Oracle exact(scene);
      const oracle::Walk walk(scene, 300);
      long judged = 0;
      for (const Query& query : queries_of(scene, difficulty, 5, 60)) {
        const Answer second = walk.first_hit(query);
        if (second.outcome == Outcome::undecided) continue;
        ++judged;
        INFO(stream(scene, query));
        REQUIRE(same(exact.first_hit(query), second));
      }
      if (difficulty == Kind::uniform && !name.starts_with("superposition"))
        CHECK(judged > 50);  // 59 seen at least
    }
}

TEST_CASE("The mean free path of every scene without overlaps is Santalo's", "[cases][catalogue_campaign]") {
  int scenes = 0;
  for (const auto& [name, scene] : all_scenes()) {
    if (overlaps(scene) || !is_crystal(scene)) continue;
    CAPTURE(name);
    ++scenes;
    const double expected = filling_of(scene)->mean_free_path;
    constexpr int kFlights = 20'000;
    const oracle::Certified certified(scene);
    const starts::FreeStarts starts(scene, starts::Kind::surface, 7);
    Query query;
    double sum = 0, sum2 = 0;
    for (int i = 0; i < kFlights; ++i) {
      starts.draw(static_cast<std::uint64_t>(i), query);
      const Answer answer = certified.first_hit(query);
      INFO(stream(scene, query));
      REQUIRE(answer.outcome == Outcome::hit);
      sum += *answer.time, sum2 += *answer.time * *answer.time;
    }
    const double mean = sum / kFlights, spread = std::sqrt((sum2 / kFlights - mean * mean) / kFlights);
    CAPTURE(mean, spread, expected);
    CHECK(spread < 0.1 * expected);
    CHECK(std::fabs(mean - expected) < 4 * spread);
  }
  CHECK(scenes >= 16);  // 20 seen
}
