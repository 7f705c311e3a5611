#include "statistics/theory/tail_constant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace lorentz::flights {
namespace {

constexpr double kLeastCount = 25;
constexpr std::size_t kLeastBinsOfTail = 4;

// A merged bin: the contribution of either term between its ends, for a coefficient of 1, and the count.
struct MergedBin {
  double leading, next, count;
};

class MergedBins {
 public:
  MergedBins(const SlowTail& tail, double total) : tail_(tail), total_(total) {}

  // Adds the bin from `from`, where the previous bin ended, up to `to`.
  void add(double from, double to, double count) {
    const auto term = [&](double power) {
      return total_ * (std::pow(from, -power) - (std::isfinite(to) ? std::pow(to, -power) : 0));
    };
    const MergedBin row{term(tail_.power), term(tail_.power + tail_.approach), count};
    if (rows_.empty() || rows_.back().count >= kLeastCount)
      rows_.push_back(row);
    else
      merge(row);
  }
  // Merges the last bin with the one before if its count is too small.
  std::vector<MergedBin> all() {
    if (rows_.size() > 1 && rows_.back().count < kLeastCount) {
      const MergedBin rest = rows_.back();
      rows_.pop_back();
      merge(rest);
    }
    return rows_;
  }

 private:
  void merge(const MergedBin& row) {
    MergedBin& last = rows_.back();
    last = {last.leading + row.leading, last.next + row.next, last.count + row.count};
  }

  const SlowTail tail_;
  const double total_;
  std::vector<MergedBin> rows_;
};

struct TailFit {
  double leading = 0, next = 0, variance = 0;  // variance: of `leading`
};

// One step. The variance of a count is the expectation of the previous fit.
TailFit weighted_fit(const std::vector<MergedBin>& rows, const std::optional<TailFit>& before) {
  double aa = 0, ab = 0, bb = 0, ac = 0, bc = 0;
  for (const MergedBin& row : rows) {
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
                                          const SlowTail& tail, double from) {
  if (edges.empty() || counts.size() != edges.size() + 1)
    throw std::invalid_argument("bins: one count more than edges is wanted");
  std::size_t first = 0;
  while (first < edges.size() && edges[first] < from) ++first;
  MergedBins rows(tail, static_cast<double>(total));
  TailConstant result;
  for (std::size_t i = first; i < edges.size(); ++i) {
    const bool last = i + 1 == edges.size();
    rows.add(edges[i], last ? std::numeric_limits<double>::infinity() : edges[i + 1],
             static_cast<double>(counts[i + 1]));
    result.count += counts[i + 1];
  }
  const std::vector<MergedBin> all = rows.all();
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
