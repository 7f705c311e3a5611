// Real quadratic numbers (a +- sqrt(d)) / q, the form of collision times, points and normals. Comparison and
// rounding are exact, by integer arithmetic alone; no precision is ever guessed. Private to oracle/.
#pragma once

#include <string>

#include "oracle/integers/integer.hpp"

namespace lorentz::oracle {

/// The number (a + sign * sqrt(d)) / q * 2^exponent, with d >= 0, q > 0, sign = +1 or -1.
struct Quadratic {
  Z a;
  int sign = -1;
  Z d;
  Z q = 1;
  long exponent = 0;
};

/// Sign of a + sign * sqrt(d): -1, 0 or +1.
int sign_of(const Z& a, int sign, const Z& d);

/// Sign of (s1 - sqrt(d1)) - (s2 - sqrt(d2)).
int compare_entries(const Z& s1, const Z& d1, const Z& s2, const Z& d2);

/// Sign of (s1 - sqrt(d1)) / q1 - (s2 - sqrt(d2)) / q2, with q1, q2 > 0: the order of two entries on one
/// line.
int compare_entries(const Z& s1, const Z& d1, const Z& q1, const Z& s2, const Z& d2, const Z& q2);

/// Sign of the number minus a binary64 value.
int compare(const Quadratic& number, double value);

/// The nearest binary64, ties to even, with gradual underflow; +0 for zero, an infinity beyond the largest
/// binary64.
double round_to_binary64(const Quadratic& number);

/// The same for sign * sqrt(square), with square >= 0. The components of an ellipsoid's normal have this
/// form.
double round_root_to_binary64(const Quadratic& square, int sign);

/// `digits` >= 1 significant decimal digits, rounded half to even. The text is positional for exponents from
/// -7 to `digits` - 1, else d.ddde+x. Zero is "0".
std::string round_to_decimal(const Quadratic& number, int digits);

}  // namespace lorentz::oracle
