#include "statistics/theory/fit.hpp"

#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "statistics/theory/merged_bins.hpp"

namespace lorentz::flights {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Bin {
  double expected;
  std::uint64_t count;

  void operator+=(const Bin& other) { expected += other.expected, count += other.count; }
};

// Neighbouring bins are merged until 25 paths are expected in each.
std::vector<Bin> bins_of(std::span<const double> edges, std::span<const std::uint64_t> counts, double total,
                         const std::function<double(double)>& survival) {
  constexpr double kLeastExpected = 25;
  std::vector<Bin> bins;
  double longer = 1;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double still_longer = i == edges.size() ? 0 : survival(edges[i]);
    bins.push_back({total * (longer - still_longer), counts[i]});
    longer = still_longer;
  }
  return merged(bins, [](const Bin& bin) { return bin.expected >= kLeastExpected; });
}

// Whether the survival falls from 1 to 0, up to rounding. If not, some bin has a negative probability, which
// merging may hide.
bool is_law(std::span<const double> edges, const std::function<double(double)>& survival) {
  double before = 1;
  for (const double edge : edges) {
    const double now = survival(edge);
    if (!(now >= 0 && now <= before * (1 + 1e-12))) return false;
    before = now;
  }
  return true;
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
  const std::vector<Bin> bins = bins_of(edges, counts, static_cast<double>(total), survival);
  ChiSquared result;
  for (const Bin& bin : bins) result.statistic += statistic_of(bin);
  result.degrees = static_cast<int>(bins.size()) - 1;
  if (!is_law(edges, survival)) result.statistic = kInfinity;
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
  result.to = edges.back();
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

}  // namespace lorentz::flights
