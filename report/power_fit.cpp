#include "report/power_fit.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "report/share.hpp"

namespace lorentz::report {
namespace {

// The t that Student's t with `degrees` degrees of freedom exceeds in absolute value with probability 5 %.
double student_t(double degrees) {
  const double x = beta_quantile(degrees / 2, 0.5, 0.05);  // degrees / (degrees + t^2)
  return std::sqrt(degrees * (1 - x) / x);
}

}  // namespace

std::optional<PowerFit> power_fit(const std::vector<std::pair<double, double>>& points) {
  const auto n = static_cast<double>(points.size());
  double mean_x = 0, mean_y = 0;
  for (const auto& [x, y] : points) {
    if (!(x > 0 && y > 0 && std::isfinite(x) && std::isfinite(y)))
      throw std::invalid_argument("power_fit: numbers above zero");
    mean_x += std::log(x) / n, mean_y += std::log(y) / n;
  }
  double xx = 0, xy = 0, yy = 0;
  for (const auto& [x, y] : points) {
    const double a = std::log(x) - mean_x, b = std::log(y) - mean_y;
    xx += a * a, xy += a * b, yy += b * b;
  }
  const auto [smallest, largest] = std::minmax_element(points.begin(), points.end());
  if (points.size() < 3 || smallest->first == largest->first) return std::nullopt;
  PowerFit fit;
  fit.exponent = xy / xx;
  const double rest = std::max(yy - xy * xy / xx, 0.0);  // what the line does not explain
  const double error = student_t(n - 2) * std::sqrt(rest / (n - 2) / xx);
  fit.low = fit.exponent - error, fit.high = fit.exponent + error;
  fit.from = smallest->first, fit.to = largest->first;
  return fit;
}

}  // namespace lorentz::report
