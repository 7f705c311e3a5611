// The inverse of the incomplete beta function, by Boost.Math.
#pragma once

namespace lorentz::report {

/// The x in [0, 1] with I_x(a, b) = p, for a and b above 0.
double beta_quantile(double a, double b, double p);
/// The x in [0, 1] with I_x(a, b) = 1 - q.
double beta_quantile_from_above(double a, double b, double q);

}  // namespace lorentz::report
