// Tests whether counted free paths follow a law, and measures the power with which they fall, and the
// constant of a tail that is approached slowly. The input is only counts in bins, because 10^9 paths cannot
// be stored.
//
// Bins: the edges e_0 < e_1 < .. < e_n, and n + 2 counts of paths: below e_0, in [e_0, e_1), .., and from e_n
// on. The last count includes endless paths. Functions throw std::invalid_argument for bad bins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace lorentz::flights {

/// Pearson's test of a law without free parameters.
struct ChiSquared {
  double statistic = 0;           ///< infinite if a count has probability 0, or the law is invalid
  int degrees = 0;                ///< merged bins minus one, because they add up to the total
  std::optional<double> p_value;  ///< P(a statistic this large or larger | the law); empty if there is only
                                  ///< one bin, because then nothing is tested
};

/// `total` paths were flown; the counts add up to it. `survival(t)` is P(path > t). Bins with fewer than 25
/// expected paths are merged with their neighbours. Expectations are total times probability: a survival that
/// is 2 % too large everywhere counts as wrong and is not rescaled.
ChiSquared chi_squared(std::span<const double> edges, std::span<const std::uint64_t> counts,
                       std::uint64_t total, const std::function<double(double)>& survival);

/// The exponent of the power law that fits the density best for t >= from, by maximum likelihood. This local
/// exponent is a property of the density in that range, not its asymptotic power.
struct TailExponent {
  double exponent = 0;
  double low = 0, high = 0;  ///< 95 % interval of the local exponent from `from` on
  double from = 0;           ///< the first edge in use
  std::uint64_t count = 0;   ///< paths from `from` on
};

/// The local exponent of the longest k of n paths: k = max(least_count, n^(2 / (2 + a)) / 4), where a, the
/// survival's exponent, comes from the longest `least_count` alone. If the relative distance of a density
/// from its power law is of the order 1/t, its local exponent there differs from that power by about the
/// statistical error (Hall, J. R. Statist. Soc. B 44, 1982). local_exponent computes this local exponent.
/// Empty if there are too few paths, or if they do not fall like a power.
/// held by "Tail exponent: intervals hold the law's local exponent 95 times in 100"
std::optional<TailExponent> tail_exponent(std::span<const double> edges,
                                          std::span<const std::uint64_t> counts,
                                          std::uint64_t least_count = 400);

/// The same from a given edge on, edges[first]. The interval is that of the likelihood ratio, scaled by the
/// scatter of the counts themselves, so that it is valid even if the density is not a power law.
std::optional<TailExponent> tail_exponent_from(std::size_t first, std::span<const double> edges,
                                               std::span<const std::uint64_t> counts);

/// The local exponent of a law from the edge `from` on, computed from the counts that the law expects. Empty
/// if the law does not fall like a power.
std::optional<double> local_exponent(std::span<const double> edges, double from,
                                     const std::function<double(double)>& survival);

struct TailConstant {
  double value = 0, error = 0;  ///< one standard error, statistical only
  double from = 0;              ///< measured on paths longer than this edge
  std::uint64_t count = 0;      ///< the number of these paths
};

/// The extrapolated constant C of P(path > t) = C t^-power (1 + O(t^-approach)). The model: the number of paths expected between a and b is `total` times the
/// difference of C t^-power + D t^-(power + approach) between a and b. C and D come from least squares,
/// weighted by the statistical errors, over the bins from the first edge on that is not below `from`. Empty
/// if fewer than 4 bins have at least 25 paths after merging with their neighbours. Throws
/// std::invalid_argument for bad bins.
std::optional<TailConstant> tail_constant(std::span<const double> edges,
                                          std::span<const std::uint64_t> counts, std::uint64_t total,
                                          double power, double approach, double from);

/// The t from which to measure the constant in 3D, in mean free paths between collisions. The terms that the
/// model leaves out bias C like 1/t, and the statistical error grows like sqrt(t^power / total). The two stay
/// in a fixed proportion if t grows like total^(1 / (2 + power)).
double tail_begins(double power, std::uint64_t total);

}  // namespace lorentz::flights
