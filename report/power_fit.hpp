// How a time grows with a size: the exponent of a power law, by least squares in logarithms.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace lorentz::report {

struct PowerFit {
  double exponent = 0;
  double low = 0, high = 0;  ///< 95 % interval by Student's t: of points that scatter about the power law
  double from = 0, to = 0;   ///< the smallest and the largest x
};

/// The exponent of y ~ x^exponent. Points are pairs (x, y), both above zero and finite, or an
/// std::invalid_argument. Nothing of fewer than three points, for then there is no interval, or if all x are
/// one.
std::optional<PowerFit> power_fit(const std::vector<std::pair<double, double>>& points);

}  // namespace lorentz::report
