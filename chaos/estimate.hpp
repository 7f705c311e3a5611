// A mean over independent parts of a run, with what its scatter tells of its error.
#pragma once

#include <cmath>
#include <vector>

namespace lorentz::chaos {

/// A number and its standard error.
struct Estimate {
  double value = 0, error = 0;
};

/// The mean of equal parts, and the standard deviation of that mean. Of one part the error is an infinity.
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

}  // namespace lorentz::chaos
