#include "statistics/theory/limit_law.hpp"

#include <cmath>
#include <numbers>

namespace lorentz::flights {
namespace {

constexpr double kPi2 = std::numbers::pi * std::numbers::pi, kLn2 = std::numbers::ln2;

// From here on the series in 1/s is used. It converges like (2/s)^n, and the closed forms lose digits because
// their terms cancel.
constexpr double kFar = 2.5;

// x ln |x|
double x_log_x(double x) {
  return x == 0 ? 0 : x * std::log(std::fabs(x));
}

// Li2(x), 0 <= x <= 1
double dilogarithm(double x) {
  if (x == 1) return kPi2 / 6;
  if (x > 0.5) return kPi2 / 6 - std::log(x) * std::log1p(-x) - dilogarithm(1 - x);
  double sum = 0, power = x;
  for (int n = 1; power > 1e-18 * n * n * sum; ++n, power *= x) sum += power / (static_cast<double>(n) * n);
  return sum;
}

// L(u) = Re Li2(1/u), an antiderivative of ln|1 - 1/u| / u; u > 0
double log_integral(double u) {
  if (u >= 1) return dilogarithm(1 / u);
  const double log = std::log(u);
  return kPi2 / 3 - log * log / 2 - dilogarithm(u);
}

double log_difference(double u) {
  return x_log_x(u - 1) - x_log_x(u);
}

// First and second antiderivatives of k(u) = (1 - 1/u)^2 ln|1 - 1/u|; g(s) = 1/s + 2 k(s) - k(s/2) / 2.
double kernel_integral(double u) {
  return log_difference(u) - 2 * log_integral(u) + x_log_x(1 - 1 / u) + 1 / u;
}
double kernel_integral_2(double u) {
  return ((u - 1) * x_log_x(u - 1) - u * x_log_x(u)) / 2 + (2 * u - 1) / 4 - (2 * u + 1) * log_integral(u) +
         3 * log_difference(u) + std::log(u);
}

// For s > 2: g(s) = sum over n >= 3 of (2^n - 4) / (n (n-1) (n-2)) s^-n, integrated once or twice from s to
// infinity, which gives each term the factors s / (n-1) and s / (n-2). Written as 8 s^-3 times a series in
// 2/s, because s may be huge.
double far(double s, int integrals) {
  double sum = 0, power = 1, four = 0.5;  // (2/s)^(n-3), 4 / 2^n
  for (int n = 3; power > 1e-17; ++n, power *= 2 / s, four /= 2) {
    const double term = power * (1 - four) / (static_cast<double>(n) * (n - 1) * (n - 1) * (n - 2));
    sum += integrals > 1 ? term / (n - 2) : term;
  }
  for (int factors = 3; factors > integrals; --factors) sum /= s;
  return 8 * sum;
}

}  // namespace

double limit_survival_from_surface(double s) {
  if (s <= 0) return 1;
  if (s <= 1) return 1 - 6 / kPi2 * s;
  if (s > kFar) return 6 / kPi2 * far(s, 1);
  return -6 / kPi2 * (1 + kLn2 + std::log(s) + 2 * kernel_integral(s) - kernel_integral(s / 2));
}

double limit_survival_from_uniform(double s) {
  if (s <= 0) return 1;
  if (s <= 1) return 1 - s + 3 / kPi2 * s * s;
  if (s > kFar) return 6 / kPi2 * far(s, 2);
  return 6 / kPi2 * (kLn2 * (s + 3) + x_log_x(s) + 2 * (kernel_integral_2(s) - kernel_integral_2(s / 2)));
}

}  // namespace lorentz::flights
