// The exact continued fraction of a slope.
#pragma once

#include <string>
#include <vector>

#include <lorentz/obstacle.hpp>

namespace lorentz::oracle {

/// One step of the expansion: partial quotient a, convergent p / q, and the signed remainder q m - p, whose
/// sign alternates: the convergent of an even index lies below m, that of an odd one above it.
struct Convergent {
  Integer a, p, q;
  double remainder = 0;         ///< correctly rounded
  std::string remainder_exact;  ///< a fraction in lowest terms, "-3/4" or "0"
};

/// All convergents of m = rise / run, two binary64 values taken exactly, until the remainder is 0 (it
/// ends: m is rational) or `limit` terms. A last quotient is above 1, except that of m = 1 alone.
/// Requires run != 0.
/// held by "Convergents satisfy their identities, exactly"
std::vector<Convergent> convergents(double rise, double run, std::size_t limit);

}  // namespace lorentz::oracle
