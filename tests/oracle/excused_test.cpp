// What the judge forgives, listed: the same as asking it about every obstacle near the flight.
#include <lorentz/verdict.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <lorentz/geometry.hpp>
#include <lorentz/margin.hpp>
#include <lorentz/oracle.hpp>
#include "fuzz/families/family.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using oracle::Judge, oracle::Verdict;

namespace {

constexpr double kUlps = 16;
constexpr std::size_t kMost = 32;

using Named = std::pair<Outcome, std::string>;

Named named(const Answer& answer) {
  const ObstacleId& o = answer.obstacle;
  return {answer.outcome, answer.outcome == Outcome::never
                              ? ""
                              : std::to_string(o.lattice) + ' ' + std::to_string(o.atom) + ' ' +
                                    o.cell[0].decimal() + ' ' + o.cell[1].decimal() + ' ' +
                                    o.cell[2].decimal()};
}

Answer hit(const ObstacleId& obstacle) {
  Answer answer = Answer::inside(obstacle);
  answer.outcome = Outcome::hit;
  return answer;
}

// The cells within two of the flight, which is `far` lengths of the shortest vector long; where a lattice repeats in
// fewer directions, those near the origin.
std::set<std::array<int, 3>> cells_near(const Lattice& lattice, int dimension, const Vec& position,
                                        const Query& query, double far) {
  const int rank = lattice.rank_in(dimension);
  std::set<std::array<int, 3>> cells;
  const auto add_around = [&](const Vec& n, int reach) {
    std::array<int, 3> most{};
    std::fill_n(most.begin(), rank, reach);
    for (int i = -most[0]; i <= most[0]; ++i)
      for (int j = -most[1]; j <= most[1]; ++j)
        for (int k = -most[2]; k <= most[2]; ++k)
          cells.insert({static_cast<int>(std::lround(n[0])) + i, static_cast<int>(std::lround(n[1])) + j,
                        static_cast<int>(std::lround(n[2])) + k});
  };
  if (rank < dimension) return add_around({}, 12), cells;
  const auto dual = dual_of(lattice.vectors, dimension);
  double shortest = length(lattice.vectors[0]);
  for (int i = 1; i < rank; ++i) shortest = std::min(shortest, length(lattice.vectors[i]));
  for (double s = 0; s <= far; s += 0.5)
    add_around(coordinates(dual, plus(plus(query.x, -1, position), s * shortest / length(query.v), query.v)),
               2);
  return cells;
}

// What the judge forgives of hits, insides and `never`, by how many ulps.
std::map<Named, double> forgiven(const Judge& judge, const Scene& scene, const Query& query,
                                 const Answer& exact, double far) {
  std::map<Named, double> all;
  const auto ask = [&](const Answer& given) {
    const oracle::Judgement judgement = judge.judge(query, exact, given, kUlps);
    if (judgement.verdict == Verdict::ill_posed) all[named(given)] = judgement.departs;
  };
  ask(Answer::never());
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l)
    for (int a = 0; a < static_cast<int>(scene.lattices[l].atoms.size()); ++a)
      for (const auto& [i, j, k] :
           cells_near(scene.lattices[l], scene.dimension, scene.lattices[l].atoms[a].position, query, far)) {
        const ObstacleId obstacle{l, a, {i, j, k}};
        if (query.from == obstacle) continue;
        ask(hit(obstacle));
        ask(Answer::inside(obstacle));
      }
  return all;
}

}  // namespace

TEST_CASE("Excused answers are those that the judge calls ill-posed", "[oracle][excused]") {
  constexpr std::uint64_t kSeed = 20261126;
  constexpr double kLongest = 12;
  int lists = 0, excused_answers = 0, too_many = 0;
  for (const cases::Family& family : cases::families())
    for (std::uint64_t index = 0; index < 48; index += 4) {
      const cases::Case one = family.make(kSeed, index);
      const Answer exact = oracle::Oracle(one.scene).first_hit(one.query);
      double unit = std::numeric_limits<double>::infinity();
      for (const Lattice& lattice : one.scene.lattices)
        for (int i = 0; i < lattice.rank_in(one.scene.dimension); ++i)
          unit = std::min(unit, length(lattice.vectors[i]));
      const double far = exact.time.value_or(0) * length(one.query.v) / unit;
      if (!(far < kLongest)) continue;
      INFO(family.name() << ' ' << index);
      const Judge judge(one.scene);
      const auto excused = judge.excused(one.query, exact, kUlps, kMost);
      const auto expected = forgiven(judge, one.scene, one.query, exact, far + 4);
      ++lists;
      if (!excused) {
        ++too_many;
        // Endless, or more than that: beyond what is looked at here, but what begins it is here.
        CHECK((exact.outcome == Outcome::never || !expected.empty()));
        continue;
      }
      std::map<Named, double> listed;
      double last = 0;
      for (const oracle::ExcusedAnswer& its : *excused) {
        CHECK(its.ulps >= last);
        last = its.ulps;
        CHECK(listed.emplace(named(its.answer), its.ulps).second);
        const oracle::Judgement judgement = judge.judge(one.query, exact, its.answer, kUlps);
        CHECK((judgement.verdict == Verdict::ill_posed && judgement.departs == its.ulps));
        ++excused_answers;
      }
      for (const auto& [answer, ulps] : expected) {
        INFO(static_cast<int>(answer.first) << ' ' << answer.second << " by " << ulps);
        CHECK((listed.contains(answer) && listed.at(answer) == ulps));
      }
    }
  INFO(lists << " questions, " << excused_answers << " excused answers, " << too_many << " with too many");
  CHECK(lists > 100);
  CHECK(excused_answers > 30);
  CHECK(too_many < lists / 4);
}

TEST_CASE("What is excused of a tangent, a tie, and a start on a surface", "[oracle][excused]") {
  const Scene scene = unit_scene(2, 0.25);
  const auto excused = [&](const Query& query, double ulps = kUlps) {
    return Judge(scene).excused(query, oracle::Oracle(scene).first_hit(query), ulps, kMost);
  };
  // Nothing is near: no other answer.
  const auto plain = excused({{0.5, 0.1, 0}, {1, 0.001, 0}, {}});
  REQUIRE(plain);
  CHECK(plain->empty());
  // Along the edge of a corridor every disc of the row is touched: endless.
  CHECK_FALSE(excused({{0.5, 0.25, 0}, {1, 0, 0}, {}}));
  // In the corridor's middle none is near, however far.
  const auto middle = excused({{0.5, 0.5, 0}, {1, 0, 0}, {}});
  REQUIRE(middle);
  CHECK(middle->empty());
  // A start on a disc, going in: it may be inside. With a smaller tolerance no less, for it takes none.
  const auto surface = excused({{0.25, 0, 0}, {-1, 0.5, 0}, {}});
  REQUIRE(surface);
  CHECK(std::ranges::any_of(*surface, [](const auto& its) { return its.answer.outcome == Outcome::inside; }));
  // Beside a plane of balls by an ulp, in a direction that is hardly known: it comes near one however far on.
  const Scene balls = unit_scene(3, 0.25);
  const Query beside{{0.25 + 0x1p-53, 0.5, 0.5}, {0, -1, 5e-324}, {}};
  const Answer never = oracle::Oracle(balls).first_hit(beside);
  REQUIRE(never.outcome == Outcome::never);
  CHECK_FALSE(Judge(balls).excused(beside, never, kUlps, kMost));
  // A hit so close to a tangent that to first order its translates along the flight are entered first.
  Scene pell = unit_scene(2, 0.144622802734375);
  const Query grazed{{0.06630492210388184, 0.12990045547485352, 0}, {51, -35, 0}, {}};
  CHECK_FALSE(Judge(pell, {NumberFormat::binary32, {}})
                  .excused(grazed, oracle::Oracle(pell).first_hit(grazed), kUlps, kMost));
}

TEST_CASE("A single ball is excused, and has a margin, however far the line misses it", "[oracle][excused]") {
  Scene scene = unit_scene(2, 1);
  scene.lattices[0].vectors = {};
  scene.lattices[0].rank = 0;
  const Query query{{-1e17, -1.0000000000000002e17, 0}, {1, 1, 0}, {}};  // by 11 radii, less than an ulp of x
  const Answer exact = oracle::Oracle(scene).first_hit(query);
  REQUIRE(exact.outcome == Outcome::never);
  const auto decision = oracle::Margins(scene).hardest_decision(query, exact);
  REQUIRE(decision);
  CHECK(decision->margin < 1);
  const auto excused = Judge(scene).excused(query, exact, kUlps, kMost);
  REQUIRE((excused && excused->size() == 1));
  CHECK(excused->front().answer.outcome == Outcome::hit);
  CHECK(excused->front().ulps == Approx(decision->margin));
}

TEST_CASE("A far start is near no copy of a single ball", "[oracle][excused]") {
  Scene scene = unit_scene(2, 1);
  scene.lattices[0].vectors = {};
  scene.lattices[0].rank = 0;
  const Query query{{-4.5e30, 3, 0}, {1, 0, 0}, {}};  // an ulp of x is 10^14 times the distance from the line
  const Answer exact = oracle::Oracle(scene).first_hit(query);
  REQUIRE(exact.outcome == Outcome::never);
  const auto excused = Judge(scene).excused(query, exact, kUlps, kMost);
  CHECK((excused && excused->empty()));
}
