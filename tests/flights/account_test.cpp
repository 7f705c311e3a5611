// Histograms, and accounts of runs: written, read, added up.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include <lorentz/errors.hpp>
#include "question/cases/random.hpp"
#include "statistics/flights/account.hpp"
#include "statistics/flights/report.hpp"
#include "statistics/flights/run.hpp"

using namespace lorentz;
using namespace lorentz::flights;

TEST_CASE("A time is counted in the bin between whose edges it lies", "[flights]") {
  cases::Random random(7301, "bins", 0);
  for (const int exponent : {-300, 0, 13}) {
    for (int i = 0; i < 20'000; ++i) {
      Bins bins(exponent);
      const int bin = static_cast<int>(random.below(Bins::kLogarithmic));
      const double low = bins.log_edge(bin), high = bins.log_edge(bin + 1);
      const double t = i % 3 == 0   ? low
                       : i % 3 == 1 ? std::nextafter(high, 0)
                                    : low + (high - low) * random.uniform();
      bins.count(t);
      REQUIRE(bins.logarithmic[static_cast<std::size_t>(bin) + 1] == 1);
      REQUIRE(high / low <= 1.125);
      const double unit = std::ldexp(1, exponent);
      const auto linear =
          static_cast<std::size_t>(std::min(t / unit * Bins::kLinearInUnit, 1.0 * Bins::kLinear));
      REQUIRE(bins.linear[linear] == 1);
      if (linear < Bins::kLinear) REQUIRE(t >= bins.linear_edge(static_cast<int>(linear)));
    }
    Bins ends(exponent);
    ends.count(0), ends.count(0x1p-1074), ends.count(ends.log_edge(Bins::kLogarithmic)), ends.count(1e308);
    CHECK(ends.logarithmic.front() == 2);
    CHECK(ends.logarithmic.back() == 2);
  }
}

namespace {

Account drawn_account(std::uint64_t seed, int flights) {
  cases::Random random(seed, "accounts", 0);
  Account account;
  account.tally = FlightTally(-3);
  for (int i = 0; i < flights; ++i) account.tally.count_hit(random.octave(-50, 70));
  account.tally.never = seed, account.tally.undecided = 2 * seed, account.tally.inside = 3;
  account.done += Blocks::interval_type(10 * seed, 10 * seed + 4);
  return account;
}

}  // namespace

TEST_CASE("An account is read as it was written", "[flights]") {
  for (const int flights : {0, 1, 5000}) {
    const Account account = drawn_account(7, flights);
    CHECK(Account::of(account.text()) == account);
    CHECK(Account::of(account.text()).text() == account.text());
  }
  const std::string text = drawn_account(7, 3).text();
  for (std::size_t cut = 0; cut + 2 < text.size(); cut += 7)
    CHECK_THROWS_AS(Account::of(text.substr(0, cut)), InputError);
}

TEST_CASE("Accounts of one plan add up, in any order", "[flights]") {
  Account a = drawn_account(1, 1000), b = drawn_account(2, 2000), c = drawn_account(3, 10);
  Account abc = a, cba = c;
  abc.add(b), abc.add(c);
  cba.add(b), cba.add(a);
  CHECK(abc == cba);
  CHECK(abc.text() == cba.text());
  CHECK(abc.tally.hits == 3010);
  CHECK(abc.done.size() == 15);
  CHECK_THROWS_AS(abc.add(a), std::invalid_argument);
}

TEST_CASE(
    "Paths below 64 spacings from surfaces are one bin of the fit, and the bin from 64 on is not among them",
    "[flights]") {
  FlightsReport report;
  report.plan.scene = unit_scene(2, 1e-3);
  report.plan.from = Ensemble::surface;
  const auto statistic_with_one_at = [&](double t) {
    report.account = Account::begun(report.plan);
    for (int i = 0; i < 10'000; ++i) report.account.tally.count_hit(0.2 * i);
    report.account.tally.count_hit(t);
    return FlightsFindings(report).fit.statistic;
  };
  const double below = statistic_with_one_at(std::nextafter(64, 0));
  CHECK(statistic_with_one_at(3) == below);
  CHECK(statistic_with_one_at(64) != below);
}
