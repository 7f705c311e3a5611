// What theory says of a run, and how the counts fit it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "statistics/flights/report.hpp"
#include "statistics/theory/fit.hpp"
#include "statistics/theory/laws.hpp"
#include "statistics/theory/tail_constant.hpp"

namespace lorentz::flights {

/// Flights that the engine left undecided are in no bin.
struct FlightsFindings {
  explicit FlightsFindings(const FlightsReport& report);

  struct Fit {
    Law law;
    ChiSquared as_it_is, two_percent_more;  ///< the second shows what the test can see
    std::optional<double> local_exponent;   ///< of its density, from where that of the flights is
  };

  std::vector<double> edges;                  ///< of the logarithmic bins
  std::vector<std::uint64_t> counts, beyond;  ///< beyond[i]: longer than edges[i], or without end
  std::uint64_t total = 0;
  std::vector<Fit> fits;
  std::string no_law;       ///< why there is none
  std::vector<Tail> tails;  ///< that of long paths the last
  std::optional<TailExponent> exponent;
  MeanFreePath mean;  ///< from collision to collision

  /// The tail's constant as measured, where the tail is approached so slowly that it must be extrapolated.
  std::optional<TailConstant> measured_constant_of(const Tail& tail) const;

 private:
  ChiSquared fit_of(const std::function<double(double)>& survival, double from) const;
};

}  // namespace lorentz::flights
