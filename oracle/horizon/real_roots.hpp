// Real roots of integer polynomials, exactly: isolated by Sturm's theorem, compared by common divisors.
// Private to oracle/.
#pragma once

#include <vector>

#include "oracle/exact/polynomial.hpp"

namespace lorentz::oracle {

/// The only root of `polynomial` in (low, low + 1] / 2^bits.
struct RealRoot {
  Polynomial polynomial;  ///< without multiple roots
  int sign_above =
      0;  ///< the polynomial's sign between the root and the interval's end; 0 if that is the root
  Z low;
  long bits = 0;

  /// Halves the interval.
  void refine();
};

/// All real roots of the polynomial, each once; none of the polynomial 0.
std::vector<RealRoot> real_roots(Polynomial polynomial);

/// Sign of a - b. Refines both; unless they are equal their intervals are disjoint afterwards.
int compare(RealRoot& a, RealRoot& b);

/// Correctly rounded.
double round_to_binary64(RealRoot root);

}  // namespace lorentz::oracle
