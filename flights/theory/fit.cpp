#include "flights/theory/fit.hpp"

#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace lorentz::flights {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void check(std::span<const double> edges, std::span<const std::uint64_t> counts) {
  if (edges.empty() || counts.size() != edges.size() + 1)
    throw std::invalid_argument("bins: one count more than edges is wanted");
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (!(edges[i] > (i ? edges[i - 1] : 0)) || !std::isfinite(edges[i]))
      throw std::invalid_argument("bins: the edges have to be above 0, finite, and ascend");
}

struct Bin {
  double from, to, expected;
  std::uint64_t count;
};

// Neighbours merged, from the left, until 25 are expected in each.
std::vector<Bin> merged(std::span<const double> edges, std::span<const std::uint64_t> counts, double total,
                        const std::function<double(double)>& survival) {
  constexpr double kLeastExpected = 25;
  std::vector<Bin> bins;
  double from = 0, longer = 1;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const bool last = i == edges.size();
    const double to = last ? kInfinity : edges[i], still_longer = last ? 0 : survival(to);
    const Bin bin{from, to, total * (longer - still_longer), counts[i]};
    from = to;
    longer = still_longer;
    if (bins.empty() || bins.back().expected >= kLeastExpected) {
      bins.push_back(bin);
    } else {
      bins.back() = {bins.back().from, bin.to, bins.back().expected + bin.expected,
                     bins.back().count + bin.count};
    }
  }
  if (bins.size() > 1 && !(bins.back().expected >= kLeastExpected)) {
    const Bin rest = bins.back();
    bins.pop_back();
    bins.back() = {bins.back().from, rest.to, bins.back().expected + rest.expected,
                   bins.back().count + rest.count};
  }
  return bins;
}

double statistic_of(const Bin& bin) {
  const double off = static_cast<double>(bin.count) - bin.expected;
  if (bin.expected > 0) return off * off / bin.expected;
  return bin.expected == 0 && bin.count == 0 ? 0 : kInfinity;
}

}  // namespace

ChiSquared chi_squared(std::span<const double> edges, std::span<const std::uint64_t> counts,
                       std::uint64_t total, const std::function<double(double)>& survival) {
  check(edges, counts);
  if (std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}) != total)
    throw std::invalid_argument("bins: the counts have to add up to the total");
  const std::vector<Bin> bins = merged(edges, counts, static_cast<double>(total), survival);
  ChiSquared result;
  const Bin* worst = &bins[0];
  for (const Bin& bin : bins) {
    result.statistic += statistic_of(bin);
    if (statistic_of(bin) > statistic_of(*worst)) worst = &bin;
  }
  result.degrees = static_cast<int>(bins.size()) - 1;
  result.worst_from = worst->from;
  result.worst_to = worst->to;
  result.worst_count = worst->count;
  result.worst_expected = worst->expected;
  if (!(result.statistic < kInfinity))
    result.p_value = 0;
  else if (result.degrees > 0)
    result.p_value = boost::math::gamma_q(result.degrees / 2.0, result.statistic / 2);
  return result;
}

namespace {

// Bins from a first edge on, under the power law P(path > t) = (t / first edge)^-a. In u = ln t this is an
// exponential law, whose likelihood is concave in a.
class BinnedTail {
 public:
  BinnedTail(std::size_t first, std::span<const double> edges, std::span<const std::uint64_t> counts) {
    for (std::size_t i = first; i < edges.size(); ++i) {
      starts_.push_back(std::log(edges[i] / edges[first]));
      counts_.push_back(static_cast<double>(counts[i + 1]));
      total_ += counts[i + 1];
    }
  }

  std::uint64_t total() const { return total_; }

  double log_likelihood(double a) const {
    double sum = 0;
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      sum -= counts_[i] * a * starts_[i];
      if (i + 1 < starts_.size()) sum += counts_[i] * std::log(-std::expm1(-a * width(i)));
    }
    return sum;
  }

  // Its derivative.
  double slope(double a) const {
    double sum = 0;
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      sum -= counts_[i] * starts_[i];
      if (i + 1 < starts_.size()) sum += counts_[i] * width(i) / std::expm1(a * width(i));
    }
    return sum;
  }

  // Kolmogorov-Smirnov distance at the edges.
  double distance(double a) const {
    double above = static_cast<double>(total_), far = 0;
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      far = std::max(far, std::fabs(above / static_cast<double>(total_) - std::exp(-a * starts_[i])));
      above -= counts_[i];
    }
    return far;
  }

 private:
  double width(std::size_t i) const { return starts_[i + 1] - starts_[i]; }

  std::vector<double> starts_, counts_;
  std::uint64_t total_ = 0;
};

// Where a function that falls through 0 between `low` and `high` does so.
double zero_of(const std::function<double(double)>& falling, double low, double high) {
  for (int step = 0; step < 200 && high - low > 1e-14 * high; ++step) {
    const double middle = (low + high) / 2;
    (falling(middle) > 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

constexpr double kSteepest = 1000;  // no tail falls like t^-1000
constexpr std::size_t kLeastBins = 3;

}  // namespace

std::optional<TailExponent> tail_exponent_from(std::size_t first, std::span<const double> edges,
                                               std::span<const std::uint64_t> counts) {
  check(edges, counts);
  if (first + kLeastBins >= edges.size()) return std::nullopt;
  const BinnedTail tail(first, edges, counts);
  const bool falls = tail.total() > 0 && tail.slope(1e-6) > 0 && tail.slope(kSteepest) < 0;
  if (!falls) return std::nullopt;
  const double a = zero_of([&](double x) { return tail.slope(x); }, 1e-6, kSteepest);
  // The likelihood that is e^(-1.92..) of the largest: half the 95 % point of chi-squared with one degree.
  const double least = tail.log_likelihood(a) - 1.9207294103470620;
  TailExponent result;
  result.exponent = a + 1;
  result.low = 1 + zero_of([&](double x) { return least - tail.log_likelihood(x); }, 1e-6, a);
  result.high = 1 + zero_of([&](double x) { return tail.log_likelihood(x) - least; }, a, kSteepest);
  result.from = edges[first];
  result.to = edges.back();
  result.count = tail.total();
  result.distance = tail.distance(a);
  return result;
}

std::optional<TailExponent> tail_exponent(std::span<const double> edges,
                                          std::span<const std::uint64_t> counts, std::uint64_t least_count) {
  check(edges, counts);
  std::optional<TailExponent> best;
  for (std::size_t first = 0; first < edges.size(); ++first) {
    const auto tail = tail_exponent_from(first, edges, counts);
    if (tail && tail->count >= least_count && (!best || tail->distance < best->distance)) best = tail;
  }
  return best;
}

}  // namespace lorentz::flights
