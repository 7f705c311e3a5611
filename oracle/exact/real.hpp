// Real numbers of 150 digits and any exponent, for quantities that are reported and not decided upon:
// margins, conditions. Differences that could cancel are taken in integers before. Private to oracle/.
#pragma once

#include <boost/multiprecision/gmp.hpp>

#include "oracle/integers/integer.hpp"

namespace lorentz::oracle {

using Real =
    boost::multiprecision::number<boost::multiprecision::gmp_float<150>, boost::multiprecision::et_off>;

inline Real real(const Z& a) {
  return Real(static_cast<mpz_srcptr>(a.view()));
}

inline Real times_power_of_two(const Real& a, long exponent) {
  return ldexp(a, exponent);
}

/// The smallest integer >= a.
inline Z ceiling(const Real& a) {
  return Z(boost::multiprecision::mpz_int(Real(ceil(a))).backend().data());
}

/// To binary64, downwards; no more than `most`.
inline double to_double(const Real& a, double most) {
  return a >= most ? most : mpf_get_d(a.backend().data());
}

}  // namespace lorentz::oracle
