// Exact times of entries and exits for certificate_check: compared with each other and with rounded times. Shares
// nothing with quadratic.*. Private to oracle/.
#pragma once

#include <string>

#include "oracle/integers/integer.hpp"

namespace lorentz::oracle::certificate {

/// Sign of a + sqrt(c) - sqrt(b), for b, c >= 0.
int sign_of(const Z& a, const Z& c, const Z& b);

/// The time (s - sqrt(d)) / q of an entry, or (s + sqrt(d)) / q of an exit; q > 0.
struct ProofTime {
  Z s = 0, d = 0, q = 1;
  bool is_exit = false;

  /// Sign of this minus n / m, m > 0.
  int compare(const Z& n, const Z& m) const;
  /// Sign of this minus n 2^k.
  int compare_dyadic(const Z& n, long k) const;
};

/// Sign of a - b, for two entries.
int compare(const ProofTime& a, const ProofTime& b);

/// True if the exact time, which must not be negative, rounds to `given`: to nearest, ties to even, and
/// beyond the largest binary64 to infinity.
bool rounds_to(const ProofTime& exact, double given);

/// True if these are the first significant digits of the exact time, which must not be negative, rounded half
/// to even.
bool rounds_to(const ProofTime& exact, const std::string& given);

}  // namespace lorentz::oracle::certificate
