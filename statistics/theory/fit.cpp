#include "statistics/theory/fit.hpp"

#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace lorentz::flights {
namespace {

// Throws std::invalid_argument for bad bins.
void check_bins(std::span<const double> edges, std::span<const std::uint64_t> counts) {
  if (edges.empty() || counts.size() != edges.size() + 1)
    throw std::invalid_argument("bins: one count more than edges is wanted");
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (!(edges[i] > (i ? edges[i - 1] : 0)) || !std::isfinite(edges[i]))
      throw std::invalid_argument("bins: the edges have to be above 0, finite, and ascend");
}

// Merges neighbouring bins, from the left, until each is_full, and the rest with the last that is.
template <class Bin, class IsFull>
std::vector<Bin> merged_bins(const std::vector<Bin>& bins, const IsFull& is_full) {
  std::vector<Bin> all;
  for (const Bin& bin : bins)
    if (all.empty() || is_full(all.back()))
      all.push_back(bin);
    else
      all.back() += bin;
  if (all.size() > 1 && !is_full(all.back())) {
    const Bin rest = all.back();
    all.pop_back();
    all.back() += rest;
  }
  return all;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeastCount = 25;  // of paths in a bin

struct Bin {
  double expected;
  std::uint64_t count;

  void operator+=(const Bin& other) { expected += other.expected, count += other.count; }
};

// Neighbouring bins are merged until 25 paths are expected in each. `is_law`: whether the survival falls from 1 to
// 0, up to rounding. If not, some bin has a negative probability, which merging may hide.
std::vector<Bin> bins_of(std::span<const double> edges, std::span<const std::uint64_t> counts, double total,
                         const std::function<double(double)>& survival, bool& is_law) {
  std::vector<Bin> bins;
  double longer = 1;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double still_longer = i == edges.size() ? 0 : survival(edges[i]);
    is_law &= still_longer >= 0 && still_longer <= longer * (1 + 1e-12);
    bins.push_back({total * (longer - still_longer), counts[i]});
    longer = still_longer;
  }
  return merged_bins(bins, [](const Bin& bin) { return bin.expected >= kLeastCount; });
}

double statistic_of(const Bin& bin) {
  const double off = static_cast<double>(bin.count) - bin.expected;
  if (bin.expected > 0) return off * off / bin.expected;
  return bin.expected == 0 && bin.count == 0 ? 0 : kInfinity;
}

}  // namespace

ChiSquared chi_squared(std::span<const double> edges, std::span<const std::uint64_t> counts,
                       std::uint64_t total, const std::function<double(double)>& survival) {
  check_bins(edges, counts);
  if (std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}) != total)
    throw std::invalid_argument("bins: the counts have to add up to the total");
  bool is_law = true;
  const std::vector<Bin> bins = bins_of(edges, counts, static_cast<double>(total), survival, is_law);
  ChiSquared result;
  for (const Bin& bin : bins) result.statistic += statistic_of(bin);
  result.degrees = static_cast<int>(bins.size()) - 1;
  if (!is_law) result.statistic = kInfinity;
  if (!(result.statistic < kInfinity))
    result.p_value = 0;
  else if (result.degrees > 0)
    result.p_value = boost::math::gamma_q(result.degrees / 2.0, result.statistic / 2);
  return result;
}

namespace {

// Bins from a first edge on, with the counts, observed or expected, in them and beyond the last edge. The
// model is the power law P(path > t) = (t / first edge)^-a. In u = ln t this is an exponential law, whose
// likelihood is concave in a.
class BinnedTail {
 public:
  void add(double distance, double count) {
    starts_.push_back(distance);
    counts_.push_back(count);
    total_ += count;
  }

  double total() const { return total_; }

  double log_likelihood(double a) const {
    return over_bins([&](std::size_t i, bool last) {
      return -a * starts_[i] + (last ? 0 : std::log(-std::expm1(-a * width(i))));
    });
  }
  // The derivative of the log-likelihood: the sum of the paths' scores.
  double slope(double a) const {
    return over_bins([&](std::size_t i, bool last) { return score(a, i, last); });
  }
  // The variance of that sum as estimated from the counts, divided by the variance under the power law. If
  // the law is a power law, this ratio is 1 up to statistical error.
  double scatter(double a) const {
    const double squares =
        over_bins([&](std::size_t i, bool last) { return score(a, i, last) * score(a, i, last); });
    const double information = over_bins([&](std::size_t i, bool last) {
      if (last) return 0.0;
      const double half = std::sinh(a * width(i) / 2);
      return width(i) * width(i) / (4 * half * half);
    });
    return squares / information;
  }

 private:
  double width(std::size_t i) const { return starts_[i + 1] - starts_[i]; }
  double score(double a, std::size_t i, bool last) const {
    return -starts_[i] + (last ? 0 : width(i) / std::expm1(a * width(i)));
  }
  template <class Of>
  double over_bins(const Of& of) const {
    double sum = 0;
    for (std::size_t i = 0; i < starts_.size(); ++i)
      if (counts_[i] > 0) sum += counts_[i] * of(i, i + 1 == starts_.size());
    return sum;
  }

  std::vector<double> starts_, counts_;
  double total_ = 0;
};

// The sign change of a function between `low` and `high`, to 13 digits.
double zero_of(const std::function<double(double)>& f, double low, double high) {
  std::uintmax_t steps = 200;
  const auto [below, above] =
      boost::math::tools::toms748_solve(f, low, high, boost::math::tools::eps_tolerance<double>(44), steps);
  return (below + above) / 2;
}

// Tails fall like t^-(1 + a) with a in this range. (Outside it, a cannot be determined from counts.)
constexpr double kFlattest = 1e-6, kSteepest = 1000;
constexpr std::size_t kLeastBins = 3;

// The a of maximum likelihood, or nothing.
std::optional<double> best_power(const BinnedTail& tail) {
  const auto slope = [&](double a) { return tail.slope(a); };
  if (!(tail.total() > 0) || !(slope(kFlattest) > 0) || !(slope(kSteepest) < 0)) return std::nullopt;
  double high = 1;  // a bracket of a factor of 2
  while (slope(high) > 0) high *= 2;
  while (high > kFlattest && slope(high / 2) < 0) high /= 2;
  return zero_of(slope, high / 2, high);
}

}  // namespace

std::optional<TailExponent> tail_exponent_from(std::size_t first, std::span<const double> edges,
                                               std::span<const std::uint64_t> counts) {
  check_bins(edges, counts);
  if (first >= edges.size() || edges.size() - 1 - first < kLeastBins) return std::nullopt;
  BinnedTail tail;
  for (std::size_t i = first; i < edges.size(); ++i)
    tail.add(std::log(edges[i] / edges[first]), static_cast<double>(counts[i + 1]));
  const std::optional<double> a = best_power(tail);
  constexpr double kLeastScatter = 1e-6;  // below, all paths are in one bin, so that no error is known
  const double scatter = a ? tail.scatter(*a) : 0;
  if (scatter < kLeastScatter) return std::nullopt;
  // Half the 95 % point of chi-squared with one degree of freedom, in units in which the slope scatters as
  // under a power law (Kent, Biometrika 69, 1982).
  const double least = tail.log_likelihood(*a) - 1.9207294103470620 * scatter;
  const auto likely = [&](double x) { return tail.log_likelihood(x) - least; };
  TailExponent result;
  result.exponent = 1 + *a;
  result.low = likely(kFlattest) < 0 ? 1 + zero_of(likely, kFlattest, *a) : 1;
  result.high = likely(kSteepest) < 0 ? 1 + zero_of(likely, *a, kSteepest) : kInfinity;
  result.from = edges[first];
  result.count = static_cast<std::uint64_t>(tail.total());
  return result;
}

namespace {

// The last edge with at least `paths` paths beyond it.
std::optional<std::size_t> edge_before(double paths, std::span<const double> edges,
                                       std::span<const std::uint64_t> counts) {
  double beyond = 0;
  for (std::size_t i = edges.size(); i-- > 0;)
    if ((beyond += static_cast<double>(counts[i + 1])) >= paths) return i;
  return std::nullopt;
}

}  // namespace

std::optional<TailExponent> tail_exponent(std::span<const double> edges,
                                          std::span<const std::uint64_t> counts, std::uint64_t least_count) {
  check_bins(edges, counts);
  const auto least = static_cast<double>(least_count);
  const auto far = edge_before(least, edges, counts);
  const auto pilot = far ? tail_exponent_from(*far, edges, counts) : std::nullopt;
  if (!pilot) return std::nullopt;
  const auto all = static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
  const double share = 0.25 * std::pow(all, 2 / (1 + pilot->exponent));
  const auto first = edge_before(std::max(least, share), edges, counts);
  return first ? tail_exponent_from(*first, edges, counts) : pilot;
}

std::optional<double> local_exponent(std::span<const double> edges, double from,
                                     const std::function<double(double)>& survival) {
  BinnedTail tail;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges[i] < from) continue;
    const double beyond = i + 1 < edges.size() ? survival(edges[i + 1]) : 0;
    tail.add(std::log(edges[i] / from), survival(edges[i]) - beyond);
  }
  const std::optional<double> a = best_power(tail);
  return a ? std::optional(1 + *a) : std::nullopt;
}

// ---- The constant of a tail that is approached slowly

namespace {

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
  const auto all = merged_bins(bins, [](const TailBin& bin) { return bin.count >= kLeastCount; });
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
