// Real roots of integer polynomials, exactly: isolated by Sturm's theorem, and compared by common divisors.
// Private to oracle/.
#pragma once

#include <vector>

#include "oracle/exact/polynomial.hpp"

namespace lorentz::oracle {

/// 2^(bits * degree) p(a / 2^bits); for bits < 0, p(a / 2^bits). `degree` is at least that of p.
Z value_at(const Polynomial& p, std::size_t degree, const Z& a, long bits);

/// The only root of `polynomial` in (low, low + 1] / 2^bits.
struct RealRoot {
  Polynomial polynomial;  ///< without multiple roots
  int sign_above =
      0;  ///< the polynomial's sign between the root and the interval's upper end; 0 if that end is the root
  Z low;
  long bits = 0;

  /// Halves the interval.
  void refine();
};

/// All real roots of the polynomial, each once. The polynomial 0 gives none.
std::vector<RealRoot> real_roots(Polynomial polynomial);

/// Sign of a - b. Refines both roots; afterwards their intervals are disjoint, unless the roots are equal.
int compare(RealRoot& a, RealRoot& b);

/// Correctly rounded.
double round_to_binary64(RealRoot root);

}  // namespace lorentz::oracle
