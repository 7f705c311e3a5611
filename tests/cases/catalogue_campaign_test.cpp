// Every scene of the catalogue: `certified` gives the oracle's answers, `walk` and `classical` agree where
// they can go, and the mean free path is Santalo's.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include <lorentz/certified.hpp>
#include <lorentz/engine.hpp>
#include <lorentz/geometry.hpp>
#include <lorentz/reduction.hpp>
#include <lorentz/scene_check.hpp>
#include <lorentz/walk.hpp>
#include "cases/random.hpp"
#include "compare/hard_cases.hpp"
#include "compare/sampling.hpp"
#include "src/problem/scene_geometry.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using compare::Difficulty;

namespace {

constexpr Difficulty kDifficulties[] = {Difficulty::drawn, Difficulty::near_rational, Difficulty::grazing};

std::vector<Query> queries_of(const Scene& scene, Difficulty difficulty, std::uint64_t seed,
                              std::size_t count) {
  return compare::hard_queries(difficulty, scene, oracle::Oracle(scene), seed, count);
}

// `certified` against the oracle; how many queries the fast engine decided, in `tally`.
void hold_certified(const Scene& scene, Difficulty difficulty, std::size_t count, StageTally& tally) {
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

// A particle that leaves an obstacle, in equilibrium: uniform on the surface of all obstacles of a cell,
// directions by the cosine law. Santalo's mean is that of its next flight, exactly.
Query leaving_query(Draw& draw, const Scene& scene) {
  const int d = scene.dimension;
  std::vector<double> surfaces;
  std::vector<ObstacleId> atoms;
  double all = 0;
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l)
    for (int a = 0; a < static_cast<int>(scene.lattices[l].atoms.size()); ++a) {
      atoms.push_back({l, a, {}});
      all += surface_of(scene.lattices[l].atoms[a], d);
      surfaces.push_back(all);
    }
  const double which = all * draw.uniform();
  const std::size_t i = std::lower_bound(surfaces.begin(), surfaces.end(), which) - surfaces.begin();
  const Atom& atom = scene.lattices[atoms[i].lattice].atoms[atoms[i].atom];
  // y on the unit sphere; the surface there is stretched by |det A| |A^-T y|.
  const std::array<Vec, 3> dual = dual_of(semiaxes_of(atom, d), d);
  double most = 0;
  for (int k = 0; k < d; ++k) most += dot(dual[k], dual[k]);
  for (;;) {
    cases::Random random(draw.below(~0ull), "surface", 0);
    const Vec y = random.direction(d), v = random.direction(d);
    Vec normal{};
    for (int k = 0; k < d; ++k)
      for (int m = 0; m < 3; ++m) normal[m] += dual[k][m] * y[k];
    const double stretch = std::sqrt(dot(normal, normal)), cosine = dot(normal, v) / stretch;
    if (!(cosine > 0) || draw.uniform() > cosine * stretch / std::sqrt(most)) continue;
    const Vec place = surface_point(atom, y);
    Query query{atom.position, v, atoms[i]};
    for (int m = 0; m < 3; ++m) query.x[m] += place[m];
    return query;
  }
}

}  // namespace

TEST_CASE("certified equals the oracle on every scene of the catalogue", "[cases][catalogue_campaign]") {
  for (const auto& [name, scene] : all_scenes())
    for (const Difficulty difficulty : kDifficulties) {
      CAPTURE(name, compare::name_of(difficulty));
      StageTally tally;
      hold_certified(scene, difficulty, 300, tally);
      // Drawn queries are the fast engine's, unless obstacles overlap their own translates.
      if (difficulty == Difficulty::drawn && !Reduction::beyond(scene)) CHECK(tally.undecided < 3);  // 0 seen
    }
}

TEST_CASE("The oracle equals walk on every scene of the catalogue", "[cases][catalogue_campaign]") {
  for (const auto& [name, scene] : all_scenes())
    for (const Difficulty difficulty : kDifficulties) {
      CAPTURE(name, compare::name_of(difficulty));
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
      if (difficulty == Difficulty::drawn && !name.starts_with("superposition"))
        CHECK(judged > 50);  // 59 seen at least
    }
}

TEST_CASE("The mean free path of every scene without overlaps is Santalo's", "[cases][catalogue_campaign]") {
  int scenes = 0;
  for (const auto& [name, scene] : all_scenes()) {
    if (overlaps(scene)) continue;
    CAPTURE(name);
    ++scenes;
    const double expected = filling_of(scene)->mean_free_path;
    constexpr int kFlights = 20'000;
    const oracle::Certified certified(scene);
    Draw draw(7);
    double sum = 0, sum2 = 0;
    for (int i = 0; i < kFlights; ++i) {
      const Query query = leaving_query(draw, scene);
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
