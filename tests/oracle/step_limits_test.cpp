// Questions on which a search of margins or verdicts would never end, or not for hours, if it had no limit of
// steps (docs/verdicts.md). Each asks one search for what it says at the limit.
#include <catch2/catch.hpp>

#include <lorentz/margin.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/verdict.hpp>
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using oracle::Judge, oracle::Verdict;

namespace {

Lattice balls(int dimension, const std::vector<Vec>& vectors, double radius) {
  Lattice lattice;
  lattice.rank = static_cast<int>(vectors.size());
  std::copy(vectors.begin(), vectors.end(), lattice.vectors.begin());
  lattice.atoms = {{{}, radius, {}}};
  return lattice;
}

const Vec kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

// A flight down to a layer, far beside a row that it runs along for ever.
const Scene kBesideRow{3, {balls(3, {kX, kY}, 0.4), balls(3, {kZ}, 0.01)}};
const Query kDown{{7e15, 7e15, 7e15}, {0, 0, -1}, {}};

// Starts inside balls that reach over 10^20 cells: those at the rim contain x by less than an ulp.
const Query kInBalls{{0.5, 0.25, 0}, {1, 0.5, 0}, {}};
std::vector<Scene> vast_balls() {
  return {{2, {balls(2, {kX, kY}, 1e20)}},
          {2, {balls(2, {kX}, 1e20)}},
          {3, {balls(3, {kX, kY, kZ}, 1e20)}},
          {3, {balls(3, {kX, kY}, 1e20)}}};
}

}  // namespace

TEST_CASE("Step limits: `never`, beside a row without an end", "[oracle][verdict][limits]") {
  const Judge judge(kBesideRow);
  const Answer exact = oracle::Oracle(kBesideRow).first_hit(kDown);
  REQUIRE(exact.outcome == Outcome::hit);
  const oracle::Judgement judgement = judge.judge(kDown, exact, Answer::never(), 4);
  CHECK(judgement.verdict == Verdict::ill_posed);
  CHECK(judgement.departs == Approx(0.4 / std::sqrt(2.)).epsilon(1e-3));  // an ulp of x is 1
  CHECK(judge.judge(kDown, exact, Answer::never(), 0.25).verdict == Verdict::wrong);
  CHECK_FALSE(judge.excused(kDown, exact, 16, 32));
  CHECK(oracle::Margins(kBesideRow).hardest_decision(kDown, exact)->margin == judgement.departs);
}

TEST_CASE("Step limits: an obstacle far along the row is found all the same", "[oracle][verdict][limits]") {
  // The flight grazes the layer's balls, and meets the row's first ball after 2^40 radii.
  Scene scene{3, {balls(3, {kX}, 0.25), balls(3, {{0, 0, 0x1p30}}, 0x1p-10)}};
  scene.lattices[1].atoms[0].position = {0.5, 0.25, -1};
  scene.lattices[0].atoms[0].position = {0.5, 0, 0x1p29};
  const Query query{{0.5, 0.25 - 0x1p-54, 0}, {0, 0, 1}, {}};
  const Answer exact = oracle::Oracle(scene).first_hit(query);
  REQUIRE(exact.outcome == Outcome::hit);
  REQUIRE(exact.obstacle.lattice == 0);
  const oracle::Judgement judgement = Judge(scene).judge(query, exact, Answer::never(), 4);
  CHECK(judgement.verdict == Verdict::wrong);
  CHECK(judgement.obstacle->lattice == 1);
}

TEST_CASE("Step limits: starts inside balls of very many cells", "[oracle][verdict][margin][limits]") {
  for (const Scene& scene : vast_balls()) {
    const Judge judge(scene);
    const Answer exact = oracle::Oracle(scene).first_hit(kInBalls);
    INFO(stream(scene, kInBalls));
    REQUIRE(exact.outcome == Outcome::inside);
    // The nearest obstacle contains x by far.
    CHECK(judge.judge(kInBalls, exact, Answer::never(), 4).verdict == Verdict::wrong);
    Answer other = Answer::inside({0, 0, {5, 0, 0}});
    CHECK(judge.judge(kInBalls, exact, other, 4).verdict == Verdict::wrong);
    other.outcome = Outcome::hit;
    CHECK(judge.judge(kInBalls, exact, other, 4).verdict == Verdict::wrong);
    // The obstacle named contains x by less than an ulp of the radius, which is 16384.
    CHECK(oracle::Margins(scene).hardest_decision(kInBalls, exact)->margin < 1e-3);
    if (scene.lattices[0].rank_in(scene.dimension) > 1) CHECK_FALSE(judge.excused(kInBalls, exact, 16, 32));
  }
}
