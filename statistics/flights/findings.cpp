// The predictions of theory for a run.
#include <algorithm>
#include <cmath>

#include "statistics/flights/report.hpp"

namespace lorentz::flights {

FlightsFindings::FlightsFindings(const FlightsReport& report)
    : tails(tails_of(report.plan.scene, report.plan.from)), mean(mean_free_path_of(report.plan.scene)) {
  const FlightTally& tally = report.account.tally;
  for (int i = 0; i <= Bins::kLogarithmic; ++i) edges.push_back(tally.bins.log_edge(i));
  counts = tally.bins.logarithmic;
  counts.back() += tally.never;
  total = tally.hits + tally.never;
  std::uint64_t longer = total;
  for (std::size_t i = 0; i < edges.size(); ++i) beyond.push_back(longer -= counts[i]);
  if (total == 0) return;
  law = law_of(report.plan.scene, report.plan.from, &no_law);
  exponent = tail_exponent(edges, counts);
  if (!law) return;
  fit = fit_of(law->survival);
  fit_of_more = fit_of([this](double t) { return std::min(1.0, 1.02 * law->survival(t)); });
  if (exponent) exponent_of_law = local_exponent(edges, exponent->from, law->survival);
}

std::optional<TailConstant> FlightsFindings::measured_constant_of(const Tail& tail) const {
  if (!tail.approach || !tail.constant || !mean.value || total == 0) return std::nullopt;
  // The model has two terms: where the power is less of the flights, others are extrapolated.
  constexpr double kLeastShareOfPower = 0.75;
  const double power = *tail.exponent - 1;
  const auto share_of_power = [&](const TailConstant& found) {
    return *tail.constant * std::pow(found.from, -power) * static_cast<double>(total) /
           static_cast<double>(found.count);
  };
  for (double from = tail_begins(power, total) * *mean.value;;) {
    const auto found = tail_constant(edges, counts, total, power, *tail.approach, from);
    if (!found || share_of_power(*found) >= kLeastShareOfPower) return found;
    from = std::nextafter(found->from, HUGE_VAL);
  }
}

// All paths that show the lattice itself are one bin.
ChiSquared FlightsFindings::fit_of(const std::function<double(double)>& survival) const {
  std::size_t first = 0;
  while (first + 1 < edges.size() && edges[first] < law->smooth_from) ++first;
  std::vector<std::uint64_t> merged(counts.begin() + static_cast<std::ptrdiff_t>(first), counts.end());
  for (std::size_t i = 0; i < first; ++i) merged.front() += counts[i];
  return chi_squared(std::span(edges).subspan(first), merged, total, survival);
}

}  // namespace lorentz::flights
