#include "report/beta_quantile.hpp"

#include <boost/math/special_functions/beta.hpp>

namespace lorentz::report {

double beta_quantile(double a, double b, double p) {
  return boost::math::ibeta_inv(a, b, p);
}

double beta_quantile_from_above(double a, double b, double q) {
  return boost::math::ibetac_inv(a, b, q);
}

}  // namespace lorentz::report
