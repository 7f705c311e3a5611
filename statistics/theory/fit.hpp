// Do counted free paths follow a law, and with which power do they fall? Counts in bins, and nothing else,
// for 10^9 paths are not kept.
//
// Bins: the edges e_0 < e_1 < .. < e_n, and n + 2 counts: of paths below e_0, in [e_0, e_1), .., and from e_n
// on, those that never end among these. Bad bins are an std::invalid_argument.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace lorentz::flights {

/// Pearson's test of a law that has no parameter left to fit.
struct ChiSquared {
  double statistic = 0;           ///< infinite if counts are where the law has no chance, or it is no law
  int degrees = 0;                ///< merged bins less one, for they add up to the total
  std::optional<double> p_value;  ///< P(a statistic so large or larger | the law); nothing if there is but
                                  ///< one bin, for nothing is tested then

  /// Of the merged bin that adds most to the statistic: its ends (0 and infinity where it has none), what was
  /// counted in it and what the law expects.
  double worst_from = 0, worst_to = 0;
  std::uint64_t worst_count = 0;
  double worst_expected = 0;
};

/// `total` paths were flown; the counts add up to it. `survival(t)` is P(path > t). Bins of which fewer than
/// 25 are expected are merged with their neighbours. Expectations are total times probability: a survival
/// that is 2 % too large everywhere is wrong, not rescaled.
ChiSquared chi_squared(std::span<const double> edges, std::span<const std::uint64_t> counts,
                       std::uint64_t total, const std::function<double(double)>& survival);

/// The exponent of the power law that is nearest to the density for t >= from: of largest likelihood. That is
/// a property of the density there, the local exponent, and not the power that it comes to in the end.
struct TailExponent {
  double exponent = 0;
  double low = 0, high = 0;  ///< 95 % interval of the local exponent from `from` on
  double from = 0, to = 0;   ///< the edges in use; what lies beyond `to` is counted, too
  std::uint64_t count = 0;   ///< of paths from `from` on
};

/// The local exponent of the longest k of n paths: k = max(least_count, n^(2 / (2 + a)) / 4), with a, the
/// survival's exponent, from the longest `least_count` alone. A density whose relative distance from its
/// power law is of the order 1/t has a local exponent there that is off by about as much as chance is (Hall,
/// J. R. Statist. Soc. B 44, 1982); local_exponent says what it is. Nothing if there are not so many paths,
/// or they fall like no power.
/// held by "Tail exponent: intervals hold the law's local exponent 95 times in 100"
std::optional<TailExponent> tail_exponent(std::span<const double> edges,
                                          std::span<const std::uint64_t> counts,
                                          std::uint64_t least_count = 400);

/// The same from a given edge on, edges[first]. The interval is that of the ratio of likelihoods, wider or
/// narrower by what the counts themselves say of the scatter: it holds though the density is no power law.
std::optional<TailExponent> tail_exponent_from(std::size_t first, std::span<const double> edges,
                                               std::span<const std::uint64_t> counts);

/// The local exponent of a law itself from `from` on, an edge: of counts as it expects them. Nothing where it
/// falls like no power.
std::optional<double> local_exponent(std::span<const double> edges, double from,
                                     const std::function<double(double)>& survival);

}  // namespace lorentz::flights
