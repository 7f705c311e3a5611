// Differences c - sqrt(a) - sqrt(b) - sqrt(d) of an integer and roots of integers, the form of the widths of
// channels. Signs and floors are exact, and so is the rounding. Private to oracle/.
#pragma once

#include "oracle/integers/integer.hpp"

namespace lorentz::oracle {

/// Sign of c - sqrt(a) - sqrt(b), for a, b >= 0.
int sign_of_rest(const Z& c, const Z& a, const Z& b);

/// Sign of c - sqrt(a) - sqrt(b) - sqrt(d), for a, b, d >= 0.
int sign_of_rest(const Z& c, const Z& a, const Z& b, const Z& d);

/// Largest integer k with c - k step - sqrt(a) - sqrt(b) - sqrt(d) > 0 (or >= 0, if `or_equal`); step > 0.
Z last_step(const Z& c, const Z& a, const Z& b, const Z& d, const Z& step, bool or_equal);

/// (c - sqrt(a) - sqrt(b)) / sqrt(n) * 2^exponent, correctly rounded; it must be above 0.
double round_rest(const Z& c, const Z& a, const Z& b, const Z& n, long exponent);

}  // namespace lorentz::oracle
