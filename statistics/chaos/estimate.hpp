// The mean over independent parts of a run, and its standard error from the scatter of the parts.
#pragma once

#include <cmath>
#include <vector>

namespace lorentz::chaos {

/// A number and its standard error.
struct Estimate {
  double value = 0, error = 0;
};

/// The mean of equal parts, and the standard deviation of that mean. With one part the error is infinite.
inline Estimate estimate_of(const std::vector<double>& parts) {
  const auto n = static_cast<double>(parts.size());
  Estimate estimate;
  for (const double part : parts) estimate.value += part / n;
  double sum = 0;
  for (const double part : parts) sum += (part - estimate.value) * (part - estimate.value);
  estimate.error = std::sqrt(sum / (n - 1) / n);
  if (!(n > 1)) estimate.error = HUGE_VAL;
  return estimate;
}

/// The ratio of two means, each over the same number of equal parts. The error is that of the deviations of
/// the parts from this ratio, to first order.
inline Estimate estimate_of_ratio(const std::vector<double>& above, const std::vector<double>& below) {
  const double mean = estimate_of(below).value, ratio = estimate_of(above).value / mean;
  std::vector<double> parts;
  for (std::size_t k = 0; k < above.size(); ++k) parts.push_back((above[k] - ratio * below[k]) / mean);
  return {ratio, estimate_of(parts).error};
}

}  // namespace lorentz::chaos
