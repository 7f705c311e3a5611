// What an engine claims: numbers of 24 bits, times within a tolerance; and what it is worth beside the oracle then.
#include <lorentz/claim.hpp>

#include <catch2/catch.hpp>

#include <cmath>

#include <lorentz/margin.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/verdict.hpp>
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using oracle::Verdict;

namespace {

constexpr NumberFormat kSingle = NumberFormat::binary32, kDouble = NumberFormat::binary64;

oracle::Judgement judged(const Scene& scene, const Query& query, const Answer& given, const Claim& claim,
                         double ulps = oracle::kDefaultUlps) {
  return oracle::Judge(scene, claim).judge(query, oracle::Oracle(scene).first_hit(query), given, ulps);
}

Answer hit_of(int atom, std::array<int, 2> cell, double time) {
  return Answer::hit({0, atom, {cell[0], cell[1], 0}}, time);
}

Scene single_discs(std::vector<Atom> atoms) {
  Scene scene = unit_scene(2, 1);
  scene.lattices[0].vectors = {}, scene.lattices[0].rank = 0;
  scene.lattices[0].atoms = std::move(atoms);
  return scene;
}

}  // namespace

TEST_CASE("Numbers of a format, and their ulps", "[problem][claim]") {
  Draw draw(3);
  for (int i = 0; i < 10'000; ++i) {
    const double any = std::ldexp(draw.between(-2, 2), static_cast<int>(draw.below(300)) - 160);
    const float nearest = static_cast<float>(any);
    CHECK(rounded(any, kSingle) == static_cast<double>(nearest));
    CHECK(rounded(any, kDouble) == any);
    const float size = std::fabs(nearest);
    if (std::isfinite(size) && size < std::numeric_limits<float>::max())
      CHECK(ulp(nearest, kSingle) ==
            static_cast<double>(std::nextafter(size, HUGE_VALF)) - static_cast<double>(size));
    CHECK(ulp(any, kDouble) == std::nextafter(std::fabs(any), HUGE_VAL) - std::fabs(any));
  }
  for (const double beyond : {HUGE_VAL, -1e300, 0x1p128}) CHECK(ulp(beyond, kSingle) == 0x1p104);
  CHECK(ulp(HUGE_VAL, kDouble) == 0x1p971);
  CHECK((ulp(0, kSingle) == 0x1p-149 && ulp(0, kDouble) == 0x1p-1074));
  CHECK((rounded(1e300, kSingle) == HUGE_VAL && rounded(1e-300, kSingle) == 0));

  Scene scene = unit_scene(2, 0.25);
  CHECK(consists_of(scene, kSingle));
  Scene third = scene, moved = scene, stretched = scene, ellipse = scene;
  third.lattices[0].atoms[0].radius = 0.1;
  moved.lattices[0].atoms[0].position[1] = 0.1;
  stretched.lattices[0].vectors[1][0] = 0.1;
  ellipse.lattices[0].atoms[0].semiaxes = {{0.25, 0, 0}, {0, 0.1, 0}};
  for (const Scene& one : {third, moved, stretched, ellipse}) {
    CHECK(consists_of(one, kDouble));
    CHECK_FALSE(consists_of(one, kSingle));
    CHECK(consists_of(rounded(one, kSingle), kSingle));
  }
  CHECK_FALSE(consists_of(Query{{0.1, 0}, {1, 0}, {}}, kSingle));
  CHECK_FALSE(consists_of(Query{{0, 0}, {1, 0.1}, {}}, kSingle));
  CHECK(consists_of(rounded(Query{{0.1, 0}, {1, 0.1}, {}}, kSingle), kSingle));
}

TEST_CASE("In binary32 an ulp is one of 24 bits", "[oracle][verdict][claim]") {
  const Scene scene = unit_scene(2, 0.25);
  const Query query{{0.5, 0.125}, {1, 0}, {}};
  const Claim claim{kSingle, {}};
  const Answer exact = oracle::Oracle(scene).first_hit(query);
  // All inputs are powers of two, but for the time: conditions in units of its ulp are the same.
  const double condition = oracle::Margins(scene, kSingle).condition(query, exact);
  CHECK(condition == Approx(oracle::Margins(scene).condition(query, exact)).epsilon(1e-14));
  const double unit = condition * 0x1p-25;
  const auto with_time = [&](double time, double ulps = 4) {
    return judged(scene, query, hit_of(0, {1, 0}, time), claim, ulps);
  };
  CHECK_FALSE(with_time(*exact.time + 3.9 * unit).wrong_time);
  CHECK(with_time(*exact.time + 4.1 * unit).wrong_time);
  CHECK(with_time(*exact.time - 0.99 * 0x1p14 * unit).wrong_time);
  CHECK_FALSE(with_time(*exact.time - 0.99 * 0x1p14 * unit).other_quantity);
  CHECK(with_time(*exact.time - 1.01 * 0x1p14 * unit).other_quantity);
  const float nearest = static_cast<float>(*exact.time);
  CHECK_FALSE(with_time(nearest, 0).wrong_time);
  CHECK(with_time(std::nextafter(nearest, 1.0F), 0).wrong_time);
  CHECK(with_time(*exact.time + 0x1p-26).ulps == 0.5);

  // A line that passes the disc by 2^-25: half an ulp of y there.
  const Query passing{{0.5, 0.25 + 0x1p-25}, {1, 0}, {}};
  const Answer grazed = hit_of(0, {1, 0}, 0.5);
  CHECK(judged(scene, passing, grazed, claim).verdict == Verdict::ill_posed);
  CHECK(judged(scene, passing, grazed, {}).verdict == Verdict::wrong);
  // An ulp beside an open corridor.
  const Query beside{{0.5, 0}, {1, 1 + 0x1p-23}, {}};
  REQUIRE(oracle::Oracle(scene).first_hit(beside).outcome == Outcome::hit);
  CHECK(judged(scene, beside, Answer::never(), claim).verdict == Verdict::ill_posed);
  CHECK(judged(scene, beside, Answer::never(), {}).verdict == Verdict::wrong);

  // Beyond the largest number a time is infinite.
  const Query slow{{0.5, 0.125}, {0x1p-140, 0}, {}};
  const auto late = [&](double time) { return judged(scene, slow, hit_of(0, {1, 0}, time), claim); };
  CHECK_FALSE(late(HUGE_VAL).wrong_time);
  CHECK(late(0x1p127).wrong_time);
  CHECK(judged(scene, slow, hit_of(0, {1, 0}, HUGE_VAL), {}).wrong_time);
}

TEST_CASE("A tolerance of times, and what it forgives of the order", "[oracle][verdict][claim]") {
  const auto within = [](double tolerance) { return Claim{kDouble, tolerance}; };
  const Scene scene = unit_scene(2, 0.25);
  const Query query{{0.5, 0.125}, {1, 0}, {}};
  const double time = *oracle::Oracle(scene).first_hit(query).time;
  const auto with_time = [&](double given, const Claim& claim) {
    return judged(scene, query, hit_of(0, {1, 0}, given), claim);
  };
  for (const double sign : {-1.0, 1.0}) {
    CHECK_FALSE(with_time(time * (1 + sign * 0.99e-3), within(1e-3)).wrong_time);
    CHECK(with_time(time * (1 + sign * 1.01e-3), within(1e-3)).wrong_time);
  }
  CHECK(with_time(std::nextafter(time, 1), within(0)).wrong_time);
  for (const double any : {-1.0, HUGE_VAL, std::nan(""), 17.0}) {
    CHECK_FALSE(with_time(any, within(HUGE_VAL)).wrong_time);
    CHECK(with_time(any, within(1e-3)).wrong_time);
  }

  // The second disc is entered 2^-11 after the first, at 1/2, while the line is still in that.
  const Scene overlapping = single_discs({{{1, 0}, 0.5, {}}, {{1 + 0x1p-11, 0}, 0.5, {}}});
  const Query ahead{{0, 0}, {1, 0}, {}};
  const auto second = [&](const Claim& claim, double ulps = 4) {
    return judged(overlapping, ahead, Answer::hit({0, 1, {}}, 0.5 + 0x1p-11), claim, ulps).verdict;
  };
  CHECK(second({}) == Verdict::wrong);
  CHECK(second(within(0x1p-10)) == Verdict::ill_posed);
  CHECK(second(within(0x1p-10), 0) == Verdict::ill_posed);
  CHECK(second(within(0x0.ffp-10)) == Verdict::wrong);
  CHECK(second(within(HUGE_VAL)) == Verdict::wrong);  // which is about times, and nothing else
  // The first disc is left when the second is entered.
  const Scene apart = single_discs({{{1, 0}, 0x1p-13, {}}, {{1 + 0x1p-10, 0}, 0x1p-13, {}}});
  CHECK(judged(apart, ahead, Answer::hit({0, 1, {}}, 1 + 0x7p-13), within(0.01)).verdict == Verdict::wrong);
}
