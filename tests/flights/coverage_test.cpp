// Do intervals hold what they are said to hold, as often as they say? Samples of laws that are known.
#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "question/cases/random.hpp"
#include "statistics/flights/run.hpp"
#include "statistics/theory/fit.hpp"
#include "statistics/theory/laws.hpp"
#include "tests/support/command_line.hpp"
#include "tests/support/scenes.hpp"

using namespace lorentz;
using namespace lorentz::flights;
using cases::Random;

namespace {

// Eight bins an octave.
std::vector<double> octaves(int low, int high) {
  std::vector<double> edges;
  for (int k = low; k < high; ++k)
    for (int j = 0; j < 8; ++j) edges.push_back(std::ldexp(1 + j / 8.0, k));
  return edges;
}

double normal(Random& random) {  // Irwin and Hall's
  double sum = -6;
  for (int k = 0; k < 12; ++k) sum += random.uniform();
  return sum;
}

// `total` paths of a law, counted. Only the long ones are drawn, one by one; the others are in one bin.
class Sampler {
 public:
  Sampler(const Law& law, double total) : edges_(octaves(-2, 60)), total_(total) {
    for (double& edge : edges_) edge *= law.scale;
    for (const double edge : edges_) survivals_.push_back(law.survival(edge));
    // Several times as many as the longest that are looked at, of which there are most in heavy tails.
    const double longest = 4 * std::max(400.0, 0.25 * std::pow(total, 2.0 / 3));
    while (first_ + 1 < edges_.size() && total * survivals_[first_ + 1] > longest) ++first_;
  }

  std::vector<std::uint64_t> draw(Random& random) const {
    std::vector<std::uint64_t> counts(edges_.size() + 1);
    const double p = survivals_[first_], expected = total_ * p,
                 drawn = std::round(expected + normal(random) * std::sqrt(expected * (1 - p)));
    for (double n = 0; n < drawn; ++n) {
      const auto after = std::upper_bound(survivals_.begin(), survivals_.end(), p * (1 - random.uniform()),
                                          std::greater<>());
      ++counts[static_cast<std::size_t>(after - survivals_.begin())];
    }
    counts[first_] = static_cast<std::uint64_t>(total_ - drawn);
    return counts;
  }
  const std::vector<double>& edges() const { return edges_; }

 private:
  std::vector<double> edges_, survivals_;
  double total_;
  std::size_t first_ = 0;
};

struct NamedLaw {
  std::string name;
  Law law;
};

// All limit laws that there are: one to three lattices of discs, ellipses, of either ensemble.
std::vector<NamedLaw> all_laws() {
  constexpr double kPi = std::numbers::pi;
  std::vector<std::pair<std::string, Scene>> scenes;
  Scene discs = unit_scene(2, 1e-4), ellipses = discs;
  const Lattice square = discs.lattices[0];
  scenes.emplace_back("1 lattice", discs);
  for (const double angle : {kPi / 5, kPi / 7}) {
    Lattice turned = square;
    const double c = std::cos(angle), s = std::sin(angle);
    turned.vectors = {{{c, s, 0}, {-s, c, 0}}};
    discs.lattices.push_back(turned);
    scenes.emplace_back(std::to_string(discs.lattices.size()) + " lattices", discs);
  }
  ellipses.lattices[0].atoms[0] = {{}, 0, {{1e-4, 3e-5, 0}, {-5e-6, 1e-5, 0}}};
  scenes.emplace_back("ellipses", ellipses);
  std::vector<NamedLaw> laws;
  for (const auto& [name, scene] : scenes)
    for (const auto ensemble : {Ensemble::uniform, Ensemble::surface})
      laws.push_back({name + (ensemble == Ensemble::uniform ? ", uniform" : ", surface"),
                      law_of(scene, ensemble).value()});
  return laws;
}

// In how many of these samples does the interval hold the law's local exponent from where it begins?
int held(const NamedLaw& of, double total, int samples) {
  const Sampler sampler(of.law, total);
  std::map<double, double> exponents;  // by where they begin
  int inside = 0;
  for (int sample = 0; sample < samples; ++sample) {
    Random random(20261123, of.name, sample);
    const auto tail = tail_exponent(sampler.edges(), sampler.draw(random));
    REQUIRE(tail);
    const auto [at, is_new] = exponents.try_emplace(tail->from);
    if (is_new) at->second = local_exponent(sampler.edges(), tail->from, of.law.survival).value();
    inside += tail->low <= at->second && at->second <= tail->high;
  }
  return inside;
}

// Within four standard deviations of 95 in 100.
bool is_95_in_100(int inside, int samples) {
  return std::fabs(inside - 0.95 * samples) < 4 * std::sqrt(0.0475 * samples);
}

}  // namespace

TEST_CASE("Local exponent: of a power law its own, of a limit law above the last one", "[flights][fit]") {
  const std::vector<double> edges = octaves(0, 40);
  CHECK(local_exponent(edges, 1, [](double t) { return std::pow(t, -1.5); }).value() == Approx(2.5));
  CHECK(local_exponent(edges, 1024, [](double t) { return 7 * std::pow(t, -3); }).value() == Approx(4));
  const double two[] = {1, 2};  // both count
  CHECK(local_exponent(two, 1, [](double t) { return 1 / (t * t); }).value() == Approx(3));
  CHECK_FALSE(local_exponent(edges, 1, [](double t) { return t < 1 ? 1.0 : 0.0; }));
  CHECK_FALSE(local_exponent(edges, 1e13, [](double t) { return 1 / t; }));  // no edge is there
  for (const NamedLaw& of : all_laws()) {
    INFO(of.name);
    const auto exponent = [&](double from) {
      std::vector<double> scaled = edges;
      for (double& edge : scaled) edge *= of.law.scale;
      return local_exponent(scaled, from * of.law.scale, of.law.survival).value();
    };
    CHECK(exponent(4) > exponent(16));
    CHECK(exponent(16) > exponent(1 << 20));
    CHECK(exponent(1 << 20) == Approx(std::round(exponent(1 << 20))).epsilon(1e-4));
  }
}

TEST_CASE("Tail exponent: intervals hold the law's local exponent 95 times in 100", "[flights][coverage]") {
  constexpr int kSamples = 200;
  int all = 0, samples = 0;
  for (const NamedLaw& of : all_laws()) {
    const int inside = held(of, 1e6, kSamples);
    INFO(of.name << ": " << inside << " of " << kSamples);
    CHECK(is_95_in_100(inside, kSamples));
    all += inside, samples += kSamples;
  }
  INFO("all: " << all << " of " << samples);
  CHECK(is_95_in_100(all, samples));
}

TEST_CASE("Tail exponent: intervals hold the local exponent of laws that are not power laws",
          "[flights][coverage]") {
  // A mixture of a steep and a flat one, and a law that falls ever faster.
  struct Bent {
    double (*survival)(double);
    double (*path)(Random&);
  };
  const auto mixture = [](Random& random) {
    const double power = random.one_in(10) ? 0.7 : 6;
    return std::pow(1 - random.uniform(), -1 / power);
  };
  const auto steeper = [](Random& random) { return std::exp(std::sqrt(-std::log(1 - random.uniform()))); };
  const std::vector<double> edges = octaves(0, 40);
  for (const Bent& bent :
       {Bent{[](double t) { return 0.9 * std::pow(t, -6) + 0.1 * std::pow(t, -0.7); }, mixture},
        Bent{[](double t) { return std::exp(-std::log(t) * std::log(t)); }, steeper}}) {
    const double exponent = local_exponent(edges, 1, bent.survival).value();
    constexpr int kSamples = 1000;
    int inside = 0;
    for (int sample = 0; sample < kSamples; ++sample) {
      Random random(20261123, "bent", sample);
      std::vector<std::uint64_t> counts(edges.size() + 1);
      for (int i = 0; i < 1000; ++i)
        ++counts[static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), bent.path(random)) -
                                          edges.begin())];
      const auto tail = tail_exponent_from(0, edges, counts).value();
      inside += tail.low <= exponent && exponent <= tail.high;
    }
    INFO("exponent " << exponent << ": " << inside << " of " << kSamples);
    CHECK(is_95_in_100(inside, kSamples));
  }
}

TEST_CASE("Flights: means, survivals and p-values of 1000 seeds", "[flights][coverage][long]") {
  // Discs of a triangular lattice with a finite horizon, off their surfaces: Santalo's mean. Discs so small
  // that the limit law is theirs, up to far less than chance: the p-values of the law.
  constexpr int kSeeds = 1000;
  const double w = 0.2;
  const Scene finite = test::one_atom(2, {Vec{2 + w, 0, 0}, {(2 + w) / 2, (2 + w) * std::sqrt(0.75), 0}}, 1);
  const double exact = mean_free_path_of(finite).value.value();
  const Scene small = unit_scene(2, 1e-5);
  const Law law = law_of(small, Ensemble::uniform).value();
  int means = 0;
  std::map<double, std::vector<double>> survivals;  // by time, each seed's
  std::vector<int> tenths(10);
  constexpr std::uint64_t kFlights = 4000;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const auto tally_of = [&](const Scene& scene, Ensemble from) {
      FlightsPlan plan;
      plan.scene = scene, plan.from = from;
      plan.seed = static_cast<std::uint64_t>(seed), plan.count = kFlights;
      Account account = Account::begun(plan);
      run(plan, {}, account);
      return account.tally;
    };
    const FlightTally one = tally_of(finite, Ensemble::surface), other = tally_of(small, Ensemble::uniform);
    means += std::fabs(one.mean() - exact) < 1.96 * one.standard_error();
    std::vector<double> edges;
    std::vector<std::uint64_t> counts{other.bins.logarithmic};
    double beyond = static_cast<double>(one.hits);
    for (int i = 0; i <= Bins::kLogarithmic; ++i) {
      edges.push_back(other.bins.log_edge(i));
      beyond -= static_cast<double>(one.bins.logarithmic[static_cast<std::size_t>(i)]);
      if (i % 8 == 0) survivals[one.bins.log_edge(i)].push_back(beyond / kFlights);
    }
    const double p = chi_squared(edges, counts, kFlights, law.survival).p_value.value();
    ++tenths[static_cast<std::size_t>(std::min(9.0, 10 * p))];
  }
  fmt::print("mean: {} of {}\n", means, kSeeds);
  CHECK(is_95_in_100(means, kSeeds));
  for (const auto& [time, of_seeds] : survivals) {
    double truth = 0;
    for (const double p : of_seeds) truth += p / kSeeds;
    if (truth * kFlights < 100 || (1 - truth) * kFlights < 100) continue;  // where counts are normal
    const auto inside = std::count_if(of_seeds.begin(), of_seeds.end(), [&](double p) {
      return std::fabs(p - truth) < 1.96 * std::sqrt(p * (1 - p) / kFlights);
    });
    fmt::print("survival {:.3g} at {:.3g}: {} of {}\n", truth, time, inside, kSeeds);
    CHECK(is_95_in_100(static_cast<int>(inside), kSeeds));
  }
  double statistic = 0;  // of 9 degrees, 27.9 is the 0.1 % point
  for (const int count : tenths) statistic += std::pow(count - kSeeds / 10.0, 2) / (kSeeds / 10.0);
  fmt::print("tenths of p-values: chi-squared {:.3g}\n", statistic);
  CHECK(statistic < 27.9);
}

TEST_CASE("Tail exponent: the same of 10^5 to 10^8 paths, 2000 samples of each law",
          "[flights][coverage][long]") {
  constexpr int kSamples = 2000;
  for (const NamedLaw& of : all_laws())
    for (const double total : {1e5, 1e6, 1e7, 1e8}) {
      const int inside = held(of, total, kSamples);
      fmt::print("{}, {:g} paths: {} of {}\n", of.name, total, inside, kSamples);
      CHECK(is_95_in_100(inside, kSamples));
    }
}
