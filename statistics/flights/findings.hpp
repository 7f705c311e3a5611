// The predictions of theory for a run, and how well the counts fit them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "statistics/flights/report.hpp"
#include "statistics/theory/fit.hpp"
#include "statistics/theory/laws.hpp"

namespace lorentz::flights {

/// Flights that the engine answers with `undecided` are in no bin.
struct FlightsFindings {
  explicit FlightsFindings(const FlightsReport& report);

  struct Fit {
    Law law;
    ChiSquared as_it_is, two_percent_more;  ///< the second shows the power of the test
    std::optional<double> local_exponent;   ///< of its density, from where that of the flights begins
  };

  std::vector<double> edges;                  ///< edges of the logarithmic bins
  std::vector<std::uint64_t> counts, beyond;  ///< beyond[i]: longer than edges[i], or endless
  std::uint64_t total = 0;
  std::vector<Fit> fits;
  std::string no_law;       ///< why no law is known
  std::vector<Tail> tails;  ///< the tail of long paths is the last
  std::optional<TailExponent> exponent;
  MeanFreePath mean;  ///< between collisions

  /// The measured constant of a tail that is approached so slowly that its constant must be extrapolated.
  std::optional<TailConstant> measured_constant_of(const Tail& tail) const;

 private:
  ChiSquared fit_of(const std::function<double(double)>& survival, double from) const;
};

}  // namespace lorentz::flights
