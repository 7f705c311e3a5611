// The constant of a tail that is approached slowly.

#include <algorithm>
#include <cmath>
#include <vector>

#include "statistics/theory/fit.hpp"
#include "statistics/theory/merged_bins.hpp"

namespace lorentz::flights {
namespace {

constexpr double kLeastCount = 25;
constexpr std::size_t kLeastBinsOfTail = 4;

// The contribution of either term between the ends of a bin, for a coefficient of 1, and the count.
struct TailBin {
  double leading, next, count;

  void operator+=(const TailBin& other) {
    leading += other.leading, next += other.next, count += other.count;
  }
};

// The bin from `from` to `to`, or without end.
TailBin bin_of(double power, double approach, double total, double from, std::optional<double> to,
               double count) {
  const auto term = [&](double its) {
    return total * (std::pow(from, -its) - (to ? std::pow(*to, -its) : 0));
  };
  return {term(power), term(power + approach), count};
}

struct TailFit {
  double leading = 0, next = 0, variance = 0;  // variance: of `leading`
};

// One step. The variance of a count is the expectation of the previous fit.
TailFit weighted_fit(const std::vector<TailBin>& rows, const std::optional<TailFit>& before) {
  double aa = 0, ab = 0, bb = 0, ac = 0, bc = 0;
  for (const TailBin& row : rows) {
    const double expected =
        before ? before->leading * row.leading + before->next * row.next : std::max(row.count, 1.0);
    const double weight = 1 / std::max(expected, 1.0);
    aa += weight * row.leading * row.leading, ab += weight * row.leading * row.next;
    bb += weight * row.next * row.next;
    ac += weight * row.leading * row.count, bc += weight * row.next * row.count;
  }
  const double determinant = aa * bb - ab * ab;
  return {(bb * ac - ab * bc) / determinant, (aa * bc - ab * ac) / determinant, bb / determinant};
}

}  // namespace

std::optional<TailConstant> tail_constant(std::span<const double> edges,
                                          std::span<const std::uint64_t> counts, std::uint64_t total,
                                          double power, double approach, double from) {
  check_bins(edges, counts);
  std::size_t first = 0;
  while (first < edges.size() && edges[first] < from) ++first;
  std::vector<TailBin> bins;
  TailConstant result;
  for (std::size_t i = first; i < edges.size(); ++i) {
    const auto to = i + 1 < edges.size() ? std::optional(edges[i + 1]) : std::nullopt;
    bins.push_back(bin_of(power, approach, static_cast<double>(total), edges[i], to,
                          static_cast<double>(counts[i + 1])));
    result.count += counts[i + 1];
  }
  const auto all = merged(bins, [](const TailBin& bin) { return bin.count >= kLeastCount; });
  if (all.size() < kLeastBinsOfTail) return std::nullopt;
  constexpr int kSteps = 5;
  std::optional<TailFit> fit;
  for (int step = 0; step < kSteps; ++step) fit = weighted_fit(all, fit);
  result.value = fit->leading;
  result.error = std::sqrt(fit->variance);
  result.from = edges[first];
  if (!std::isfinite(result.value) || !std::isfinite(result.error)) return std::nullopt;
  return result;
}

double tail_begins(double power, std::uint64_t total) {
  // For 2 10^7 flights in eight 3D scenes, the statistical error is then above the bias (docs/free_paths.md).
  return 16 / power * std::pow(static_cast<double>(total) / 1e6, 1 / (2 + power));
}

}  // namespace lorentz::flights
