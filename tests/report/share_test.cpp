// The bounds of shares, and the manifest of a report.
#include "report/share.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "report/manifest.hpp"

using namespace lorentz::report;

namespace {

// P(k or more of n), by the sum.
double chance_of_so_many(std::size_t k, std::size_t n, double share) {
  double sum = 0;
  for (std::size_t i = k; i <= n; ++i)
    sum +=
        std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) +
                 static_cast<double>(i) * std::log(share) + static_cast<double>(n - i) * std::log1p(-share));
  return sum;
}

}  // namespace

TEST_CASE("Bounds of a share are those of Clopper and Pearson", "[report][share]") {
  struct Known {
    std::size_t count, total;
    double low, high;
  };
  for (const auto& [count, total, low, high] : {Known{0, 10, 0, 0.30849710},
                                                {3, 10, 0.06673951, 0.65245285},
                                                {5, 10, 0.18708603, 0.81291397},
                                                {10, 10, 0.69150290, 1},
                                                {1, 100, 0.00025315, 0.05445939}}) {
    const Share share = share_of(count, total);
    CHECK(share.low == Approx(low).margin(1e-8));
    CHECK(share.high == Approx(high).margin(1e-8));
  }
  for (const std::size_t total : {7, 2000})
    for (const std::size_t count : {std::size_t{1}, total / 3, total - 1}) {
      const Share share = share_of(count, total);
      CHECK(chance_of_so_many(count, total, share.low) == Approx(0.025));
      CHECK(1 - chance_of_so_many(count + 1, total, share.high) == Approx(0.025));
    }
  CHECK(share_of(0, 0) == Share{0, 0, 1});
  CHECK_THROWS_AS(share_of(2, 1), std::invalid_argument);
  std::string text;
  append_json(text, {3, 0.25, 0.5});
  CHECK(text == R"({"count":3,"low":0.25,"high":0.5})");
}

TEST_CASE("Bounds of a share hold it 95 times in 100 or more, whatever it is", "[report][share][coverage]") {
  for (const std::size_t total : {1, 3, 20, 150})
    for (double share = 0.005; share < 1; share += 0.005) {
      double held = 0;
      for (std::size_t k = 0; k <= total; ++k) {
        const Share bounds = share_of(k, total);
        if (bounds.low <= share && share <= bounds.high)
          held += chance_of_so_many(k, total, share) - chance_of_so_many(k + 1, total, share);
      }
      INFO(total << " trials, share " << share);
      CHECK(held > 0.95 - 1e-9);
    }
}

TEST_CASE("What was never seen is bounded with 95 %, of few trials, too", "[report][share]") {
  CHECK(bound_of_none(0) == 1);
  CHECK(bound_of_none(1) == Approx(0.95));  // 3 / N would be 3
  for (const std::size_t total : {1, 2, 10, 1000})
    CHECK(std::pow(1 - bound_of_none(total), total) == Approx(0.05));
  CHECK(bound_of_none(1'000'000'000'000'000) == Approx(2.995732e-15));
}

TEST_CASE("A manifest says what made the numbers, whatever the command was", "[report][manifest]") {
  const Manifest manifest = manifest_of(~std::uint64_t{0}, "lorentz bench --engine 'cmd:\"a\"\n'");
  for (const std::string& text : {manifest.version, manifest.commit, manifest.compiler, manifest.flags,
                                  manifest.machine, manifest.instructions, manifest.system})
    CHECK_FALSE(text.empty());
  CHECK(manifest.flags.find("-ffp-contract=off") != std::string::npos);
  CHECK(manifest.date.size() == 10);
  std::string json;
  append_json(json, manifest);
  CHECK(json.starts_with("{\"version\":\""));
  const std::string end =
      "\"seed\":\"18446744073709551615\",\"command\":\"lorentz bench --engine 'cmd:\\\"a\\\"\\u000a'\"}";
  CHECK(json.ends_with(end));
}
