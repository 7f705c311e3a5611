// The exact continued fraction of a slope.
#pragma once

#include <string>
#include <vector>

#include <lorentz/obstacle.hpp>

namespace lorentz::oracle {

/// One step of the expansion: the partial quotient a, the convergent p / q, and the signed remainder q m - p.
/// The remainder's sign alternates: convergents of even index lie below m, those of odd index above it.
struct Convergent {
  Integer a, p, q;
  double remainder = 0;         ///< correctly rounded
  std::string remainder_exact;  ///< a fraction in lowest terms, "-3/4" or "0"
};

/// All convergents of m = rise / run, where both binary64 values are taken exactly. The expansion stops when
/// the remainder is 0 (m is rational, so it always ends) or after `limit` terms. The last quotient is above
/// 1, unless it is the only one. Requires run != 0.
std::vector<Convergent> convergents(double rise, double run, std::size_t limit);

}  // namespace lorentz::oracle
