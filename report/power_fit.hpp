// How a time grows with a size: the exponent of a power law, by least squares in logarithms.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace lorentz::report {

struct PowerFit {
  double exponent = 0;
  double low = 0, high = 0;  ///< 95 % interval by Student's t, for points that scatter about the power law
  double from = 0, to = 0;   ///< the smallest and the largest x
};

/// The exponent of y ~ x^exponent. Points are pairs (x, y), both finite and above zero; throws
/// std::invalid_argument otherwise. Nothing for fewer than three points, which give no interval, or if all x
/// are equal.
std::optional<PowerFit> power_fit(const std::vector<std::pair<double, double>>& points);

}  // namespace lorentz::report
