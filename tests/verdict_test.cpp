#include "verdict.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lorentz;
using oracle::Verdict;

namespace {

const ObstacleId kHere{0, 0, {Integer(3), Integer(2), Integer(0)}},
    kThere{0, 0, {Integer(3), Integer(1), Integer(0)}};

Verdict verdict(const Answer& exact, const Answer& given) {
  return oracle::judge(exact, given).verdict;
}

}  // namespace

TEST_CASE("Each answer gets its verdict") {
  const Answer hit = Answer::hit(kHere, 1.5);
  CHECK(verdict(hit, hit) == Verdict::agree);
  CHECK(verdict(hit, Answer::hit(kThere, 1.5)) == Verdict::wrong);
  CHECK(verdict(hit, Answer::never()) == Verdict::wrong);
  CHECK(verdict(hit, Answer::inside(kHere)) == Verdict::wrong);
  CHECK(verdict(Answer::never(), Answer::never()) == Verdict::agree);
  CHECK(verdict(Answer::never(), hit) == Verdict::wrong);
  CHECK(verdict(Answer::inside(kHere), Answer::inside(kHere)) == Verdict::agree);
  CHECK(verdict(Answer::inside(kHere), Answer::inside(kThere)) == Verdict::wrong);
  CHECK(verdict(hit, Answer::undecided()) == Verdict::undecided);
  CHECK(verdict(hit, Answer::later()) == Verdict::undecided);
  CHECK(verdict(hit, Answer::error("no")) == Verdict::error);
  CHECK(verdict(hit, Answer::unsupported_because("no")) == Verdict::unsupported);
}

TEST_CASE("Where the query is none nobody is wrong") {
  CHECK(verdict(Answer::error("v is zero"), Answer::hit(kHere, 1)) == Verdict::error);
}

TEST_CASE("Errors of the time are counted in ulps of the exact one") {
  const Answer hit = Answer::hit(kHere, 1.5);
  CHECK(oracle::judge(hit, hit).ulps == 0.0);
  CHECK(oracle::judge(hit, Answer::hit(kHere, std::nextafter(1.5, 2))).ulps == 1.0);
  CHECK(oracle::judge(hit, Answer::hit(kHere, 1.5 - 3 * 0x1p-52)).ulps == 3.0);
  Answer logged = hit;
  logged.time.reset();
  CHECK_FALSE(oracle::judge(hit, logged).ulps.has_value());
  CHECK_FALSE(oracle::judge(hit, Answer::hit(kHere, INFINITY)).ulps.has_value());
  CHECK_FALSE(oracle::judge(hit, Answer::hit(kThere, 1.5)).ulps.has_value());
}
