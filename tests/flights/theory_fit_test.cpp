// Tests of fit on samples of which the law is known.
#include "question/cases/random.hpp"
#include "statistics/theory/fit.hpp"
#include "statistics/theory/laws.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace lorentz::flights;
using lorentz::cases::Random;

namespace {

// 2^k (1 + j/8): eight bins an octave.
std::vector<double> octaves(int low, int high) {
  std::vector<double> edges;
  for (int k = low; k < high; ++k)
    for (int j = 0; j < 8; ++j) edges.push_back(std::ldexp(1 + j / 8.0, k));
  edges.push_back(std::ldexp(1, high));
  return edges;
}

using Counts = std::vector<std::uint64_t>;

template <class Path>
Counts counted(const std::vector<double>& edges, int total, const Path& path) {
  Counts counts(edges.size() + 1);
  for (int i = 0; i < total; ++i)
    ++counts[static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), path()) - edges.begin())];
  return counts;
}

// The s at which the survival has a value drawn uniformly, by a table: survival is convex, and falls.
class DrawnFromLimitLaw {
 public:
  DrawnFromLimitLaw() {
    for (double s = 0; s < 1e6; s += s < 4 ? 0x1p-10 : s / 256) {
      places_.push_back(s);
      survivals_.push_back(limit_survival_from_uniform(s));
    }
  }
  double operator()(Random& random) const {
    const double p = random.uniform();
    const auto after = std::upper_bound(survivals_.begin(), survivals_.end(), p, std::greater<>());
    if (after == survivals_.end()) return places_.back();
    const auto i = static_cast<std::size_t>(after - survivals_.begin());
    const double share = (survivals_[i - 1] - p) / (survivals_[i - 1] - survivals_[i]);
    return places_[i - 1] + share * (places_[i] - places_[i - 1]);
  }

 private:
  std::vector<double> places_, survivals_;
};

const auto kExponential = [](double t) { return std::exp(-t); };

}  // namespace

TEST_CASE("Chi-squared: by hand", "[flights][fit]") {
  // 400 paths under exp(-t), the edges at the quartiles: 100 are expected in each of four bins.
  const std::vector<double> edges{std::log(4 / 3.0), std::log(2.0), std::log(4.0)};
  const auto fit = chi_squared(edges, Counts{110, 90, 90, 110}, 400, kExponential);
  CHECK(fit.statistic == Approx(4));
  CHECK(fit.degrees == 3);
  CHECK(fit.p_value.value() == Approx(0.2614641299491106));
  // With 60 paths 15 are expected in each: the bins are merged in pairs.
  const auto merged = chi_squared(edges, Counts{20, 10, 10, 20}, 60, kExponential);
  CHECK(merged.degrees == 1);
  CHECK(merged.statistic == Approx(0).margin(1e-9));
  CHECK(merged.p_value.value() == Approx(1));
  // The rest is merged backwards: 32.5 are expected in either half.
  const auto rest = chi_squared(edges, Counts{60, 0, 0, 5}, 65, kExponential);
  CHECK(rest.degrees == 1);
  CHECK(rest.statistic == Approx(2 * 27.5 * 27.5 / 32.5));
}

TEST_CASE("Chi-squared: bad bins, and laws that give no chance", "[flights][fit]") {
  const std::vector<double> edges{1, 2};
  CHECK_THROWS_AS(chi_squared(edges, Counts{1, 2}, 3, kExponential), std::invalid_argument);
  CHECK_THROWS_AS(chi_squared(edges, Counts{1, 2, 3}, 7, kExponential), std::invalid_argument);
  CHECK_THROWS_AS(chi_squared(std::vector<double>{2, 2}, Counts{1, 2, 3}, 6, kExponential),
                  std::invalid_argument);
  CHECK_THROWS_AS(chi_squared({}, Counts{1}, 1, kExponential), std::invalid_argument);
  // All paths end before 1, says the law.
  const auto none = chi_squared(edges, Counts{1000, 0, 1}, 1001, [](double t) { return t < 1 ? 1 - t : 0; });
  CHECK(none.degrees == 0);  // one bin: nothing is expected beyond, and nothing tested
  CHECK_FALSE(none.p_value);
  const auto uncounted =
      chi_squared(edges, Counts{0, 0, 0}, 0, kExponential);  // nothing counted, nothing expected
  CHECK(uncounted.statistic == 0);
  CHECK_FALSE(uncounted.p_value);
  for (const auto& no_law : {std::function<double(double)>([](double) { return 1.5; }),
                             std::function<double(double)>([](double t) { return t < 2 ? 0.3 : 0.4; }),
                             std::function<double(double)>([](double t) { return 1 - t; })})
    CHECK(chi_squared(edges, Counts{20, 20, 20}, 60, no_law).p_value == 0);
}

TEST_CASE("Chi-squared: p-values are uniform under the law", "[flights][fit]") {
  const DrawnFromLimitLaw draw;
  std::vector<double> edges;  // few, so that one degree more or less shows; some of them to be merged
  for (int k = -3; k < 18; k += 2) edges.push_back(std::ldexp(1, k));
  constexpr int kSamples = 1000, kPaths = 10'000;
  Counts tenths(10);
  for (int sample = 0; sample < kSamples; ++sample) {
    Random random(20261122, "p-values", sample);
    const auto counts = counted(edges, kPaths, [&] { return draw(random); });
    const auto fit = chi_squared(edges, counts, kPaths, limit_survival_from_uniform);
    ++tenths[std::min(9, static_cast<int>(10 * fit.p_value.value()))];
  }
  // Their tenths by chi-squared in turn: 9 degrees, of which 27.9 is the 0.1 % point.
  double statistic = 0;
  for (const auto count : tenths) statistic += std::pow(static_cast<double>(count) - 100, 2) / 100;
  INFO("chi-squared of the tenths: " << statistic);
  CHECK(statistic < 27.9);
}

TEST_CASE("Chi-squared: a law 2 % off is rejected at 10^6 paths", "[flights][fit]") {
  const DrawnFromLimitLaw draw;
  Random random(20261122, "power", 0);
  const auto edges = octaves(-4, 20);
  const auto counts = counted(edges, 1'000'000, [&] { return draw(random); });
  const auto p_value = [&](double height, double stretch) {
    return chi_squared(edges, counts, 1'000'000,
                       [&](double s) { return height * limit_survival_from_uniform(s / stretch); })
        .p_value.value();
  };
  CHECK(p_value(1, 1) > 0.001);
  CHECK(p_value(1.02, 1) < 1e-9);
  CHECK(p_value(0.98, 1) < 1e-9);
  CHECK(p_value(1, 1.02) < 1e-9);
  CHECK(p_value(1, 0.98) < 1e-9);
  // The number of flights counts: 2 % of them lost are seen, though the form is right.
  Counts fewer = counts;
  std::uint64_t total = 0;
  for (std::size_t i = 1; i < fewer.size(); ++i) fewer[i] -= fewer[i] / 50;
  for (const auto count : fewer) total += count;
  fewer[0] += 1'000'000 - total;
  CHECK(chi_squared(edges, fewer, 1'000'000, limit_survival_from_uniform).p_value.value() < 1e-9);
}

namespace {

// How many of 1000 samples of a density ~ t^-exponent from 1 on have the exponent in their interval?
template <class Fit>
int covered(double exponent, int paths, const Fit& fit) {
  const auto edges = octaves(0, 20);
  int inside = 0;
  for (int sample = 0; sample < 1000; ++sample) {
    Random random(20261122, "tails", sample);
    const auto counts =
        counted(edges, paths, [&] { return std::pow(1 - random.uniform(), -1 / (exponent - 1)); });
    const std::optional<TailExponent> tail = fit(edges, counts);
    REQUIRE(tail);
    inside += tail->low <= exponent && exponent <= tail->high;
  }
  return inside;
}

}  // namespace

TEST_CASE("Tail exponent: intervals cover it 95 times in 100", "[flights][fit]") {
  for (const double exponent : {2.0, 3.0, 4.0}) {
    const int whole = covered(exponent, 5000, [](const auto& edges, const auto& counts) {
      return tail_exponent_from(0, edges, counts);
    });
    const int chosen = covered(
        exponent, 5000, [](const auto& edges, const auto& counts) { return tail_exponent(edges, counts); });
    INFO("exponent " << exponent << ": " << whole << ", with the start chosen " << chosen << " of 1000");
    // 950 +- 6.9
    CHECK(whole > 922);
    CHECK(whole < 978);
    CHECK(chosen > 922);
  }
}

TEST_CASE("Tail exponent: by hand", "[flights][fit]") {
  // 2^12 paths; half of those left end within each doubling: P(path > t) = 1/t, the density's exponent is 2.
  const std::vector<double> edges{1, 2, 4, 8, 16, 32};
  const Counts counts{0, 2048, 1024, 512, 256, 128, 128};
  const auto tail = tail_exponent_from(0, edges, counts);
  REQUIRE(tail);
  CHECK(tail->exponent == Approx(2).epsilon(1e-12));
  CHECK(tail->count == 4096);
  CHECK(tail->from == 1);
  // Each bin has two outcomes, goes on or not. Their information adds up: sigma = 1 / (ln 2 sqrt(2 * 3968)).
  const double sigma = 1 / (std::log(2) * std::sqrt(2 * 3968.0));
  CHECK(tail->high - tail->exponent == Approx(1.96 * sigma).epsilon(0.03));
  CHECK(tail->exponent - tail->low == Approx(1.96 * sigma).epsilon(0.03));
  // A flat tail: 4^5 paths, of which three in four go on at each edge. P(path > t) = (3/4)^log2(t).
  const auto flat = tail_exponent_from(0, edges, Counts{0, 256, 192, 144, 108, 81, 243});
  REQUIRE(flat);
  CHECK(flat->exponent == Approx(1 + std::log2(4.0 / 3)).epsilon(1e-12));
}

TEST_CASE("A tail begins later among more flights", "[flights][fit]") {
  CHECK(tail_begins(1, 1'000'000) == Approx(16));
  CHECK(tail_begins(2, 16'000'000) == Approx(16));  // 8 of a million's, times the fourth root of 16
}

TEST_CASE("Tail exponent: of so few of the longest paths that the law is a power there", "[flights][fit]") {
  // Flat up to 8, then t^-3: half of the paths are before.
  Random random(20261122, "begins", 0);
  const auto edges = octaves(-2, 14);
  const auto counts = counted(edges, 200'000, [&] {
    return random.one_in(2) ? 8 * random.uniform() : 8 / std::sqrt(1 - random.uniform());
  });
  const auto tail = tail_exponent(edges, counts);
  REQUIRE(tail);
  INFO(tail->exponent << " from " << tail->from << ", " << tail->low << " .. " << tail->high);
  CHECK(tail->from >= 32);
  CHECK(tail->count >= 400);
  CHECK(tail->low < 3);
  CHECK(tail->high > 3);
}

TEST_CASE("Tail exponent: nothing where there is too little", "[flights][fit]") {
  const std::vector<double> edges{1, 2, 4, 8, 16};
  CHECK_FALSE(tail_exponent(edges, Counts{0, 190, 100, 50, 25, 25}));
  CHECK(tail_exponent(edges, Counts{0, 200, 100, 50, 25, 25}, 400));
  CHECK_FALSE(tail_exponent(edges, Counts{900, 0, 0, 0, 0, 0}));
  CHECK_FALSE(tail_exponent(edges, Counts{0, 900, 0, 0, 0, 0}));  // falls faster than any power
  CHECK_FALSE(tail_exponent(edges, Counts{0, 0, 0, 0, 0, 900}));  // does not fall
  CHECK_FALSE(tail_exponent(edges, Counts{0, 0, 900, 0, 0, 0}));  // one bin says nothing of its scatter
  CHECK_FALSE(tail_exponent_from(2, edges, Counts{0, 200, 100, 50, 25, 25}));
  CHECK_THROWS_AS(tail_exponent(edges, Counts{1, 2}), std::invalid_argument);
  // Also where there are too few paths for an exponent.
  CHECK_THROWS_AS(tail_exponent(std::vector<double>{2, 1}, Counts{1, 1, 1}), std::invalid_argument);
}

TEST_CASE("Tail constant: extrapolated, and its error is one", "[flights][fit]") {
  // P(path > t) = 5 t^-power + 60 t^-(power + 2/3) from 100 on, counts about their expectations.
  const auto edges = octaves(5, 40);
  for (const double power : {1.0, 2.0}) {
    const auto survival = [&](double t) {
      return 5 * std::pow(t, -power) + 60 * std::pow(t, -power - 2.0 / 3);
    };
    int within_one = 0, within_two = 0;
    double sum = 0;
    constexpr std::uint64_t kPaths = 100'000'000, kSamples = 400;
    for (std::uint64_t sample = 0; sample < kSamples; ++sample) {
      Random random(20261122, "constants", sample);
      Counts counts(edges.size() + 1);
      for (std::size_t i = 0; i < edges.size(); ++i) {
        double normal = -6;  // Irwin and Hall's
        for (int k = 0; k < 12; ++k) normal += random.uniform();
        const double next = i + 1 < edges.size() ? survival(edges[i + 1]) : 0,
                     expected = kPaths * (survival(edges[i]) - next);
        counts[i + 1] =
            static_cast<std::uint64_t>(std::max(0.0, std::round(expected + normal * std::sqrt(expected))));
      }
      const auto found = tail_constant(edges, counts, kPaths, power, 2.0 / 3, 100);
      REQUIRE(found);
      CHECK(found->from == 104);
      const double off = (found->value - 5) / found->error;
      within_one += std::fabs(off) < 1, within_two += std::fabs(off) < 2;
      sum += off;
    }
    INFO("power " << power << ": " << within_one << ", " << within_two << ", mean " << sum / kSamples);
    // 273 +- 9.3, 382 +- 4.2, 0 +- 0.05
    CHECK(std::abs(within_one - 273) < 4 * 9.3);
    CHECK(std::abs(within_two - 382) < 4 * 4.2);
    CHECK(std::fabs(sum / kSamples) < 0.25);
  }
}

TEST_CASE("Tail constant: exactly of exact counts, nothing where there is too little", "[flights][fit]") {
  const std::vector<double> edges{1, 2, 4, 8, 16};
  // 2^12 paths with P(path > t) = 1/t: no second term.
  const Counts counts{0, 2048, 1024, 512, 256, 256};
  const auto found = tail_constant(edges, counts, 4096, 1, 1, 1);
  REQUIRE(found);
  CHECK(found->value == Approx(1).epsilon(1e-12));
  CHECK(found->count == 4096);
  // Twice as many flights of which half are shorter: half the constant.
  CHECK(tail_constant(edges, counts, 8192, 1, 1, 1)->value == Approx(0.5).epsilon(1e-12));
  CHECK(tail_constant(edges, counts, 4096, 1, 1, 1.5)->count == 2048);
  CHECK_FALSE(tail_constant(edges, counts, 4096, 1, 1, 3));
  CHECK_FALSE(tail_constant(edges, counts, 4096, 1, 1, 100));
  CHECK_FALSE(tail_constant(edges, Counts{0, 40, 30, 20, 4, 0}, 94, 1, 1, 1));
  CHECK_THROWS_AS(tail_constant(edges, Counts{1, 2}, 3, 1, 1, 1), std::invalid_argument);
}
