// What an engine's free paths are compared with.
#include "judge/free_paths.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/command_line.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using namespace lorentz::judge;

namespace {

// A flight that takes exactly this time.
question::Question flight(double time, double speed = 1, const Claim& claim = {}) {
  return {std::make_shared<question::Place>(unit_scene(2, 0.1), claim),
          {{}, {speed, 0, 0}, {}},
          Answer::hit({}, time)};
}

}  // namespace

TEST_CASE("Free paths that are cut short are seen, with the place where it shows most",
          "[judge][free_paths]") {
  FlownScene right, cut;
  for (int i = 1; i <= 1000; ++i) {
    const double path = 1000.0 / i;  // P(path > t) = 1 / t
    right.add(flight(path), Answer::hit({}, path * (1 + 0x1p-50)));
    cut.add(flight(path), path > 100 ? Answer::never() : Answer::hit({}, std::min(path, 30.0)));
  }
  CHECK(right.flights() == 1000);
  CHECK_FALSE(right.farthest_apart());
  CHECK(right.mean() == Approx(right.exact_mean()));
  REQUIRE(cut.farthest_apart());
  CHECK(cut.farthest_apart()->t == Approx(32));
  CHECK(cut.farthest_apart()->survival == Approx(0.009));
  CHECK(cut.farthest_apart()->exact.value() == Approx(0.031));
  CHECK(cut.mean() < cut.exact_mean());
  // From where some have ended to the longest.
  CHECK(right.points().front().t == Approx(std::sqrt(2)));
  CHECK(right.points().back().t == Approx(std::exp2(9.5)));
}

TEST_CASE("What an engine does not decide is in neither distribution", "[judge][free_paths]") {
  FlownScene paths;
  paths.add(flight(1), Answer::undecided());
  paths.add(flight(1), Answer::error("cmd died"));
  CHECK(paths.flights() == 0);
  CHECK(paths.points().empty());
  paths.add(flight(3), Answer::hit({}, 3));
  CHECK(paths.mean() == 3);
}

TEST_CASE("Free paths are lengths at any speed, and those that a domain cuts short follow no theory",
          "[judge][free_paths]") {
  FlownScene paths("square", 0.1);
  paths.add(flight(3, 16), Answer::hit({}, 3));
  CHECK(paths.mean() == 48);
  paths.add(flight(0x5p-600, 0x1p604), Answer::hit({}, 0x5p-600));
  CHECK(paths.mean() == 64);
  CHECK(contains(paths.text(), "of infinitely many 4.843"));
  CHECK_FALSE(paths.curve("engine").law.empty());
  Claim claim;
  claim.domain.flight.high = 50;
  paths.add(flight(3, 16, claim), Answer::hit({}, 3));
  CHECK_FALSE(contains(paths.text(), "infinitely"));
  CHECK(paths.curve("engine").law.empty());
}
