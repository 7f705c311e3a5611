#include "oracle/exact/root_sums.hpp"

#include "oracle/exact/quadratic.hpp"

namespace lorentz::oracle {

int sign_of_rest(const Z& c, const Z& a, const Z& b) {
  if (c < 0) return -1;
  if (c == 0) return a == 0 && b == 0 ? 0 : -1;
  // c ? sqrt(a) + sqrt(b) with both sides >= 0: compare c^2 ? a + b + 2 sqrt(a b).
  return sign_of(c * c - a - b, -1, 4 * a * b);
}

int sign_of_rest(const Z& c, const Z& a, const Z& b, const Z& d) {
  const int lead = sign_of(c, -1, d);
  if (lead < 0) return -1;
  if (lead == 0) return a == 0 && b == 0 ? 0 : -1;
  // c - sqrt(d) ? sqrt(a) + sqrt(b) with both sides >= 0: compare
  //   c^2 + d - 2 c sqrt(d) ? a + b + 2 sqrt(a b).
  return sign_of_rest(c * c + d - a - b, 4 * c * c * d, 4 * a * b);
}

Z last_step(const Z& c, const Z& a, const Z& b, const Z& d, const Z& step, bool or_equal) {
  // The roots are rounded down, so the floor is too large by at most a few.
  Z k = floor_div(c - floor_sqrt(a) - floor_sqrt(b) - floor_sqrt(d), step);
  while (sign_of_rest(c - k * step, a, b, d) < (or_equal ? 0 : 1)) --k;
  return k;
}

// Narrows the enclosure until both its ends round to the same binary64. This ends. It could fail to end only
// if the number is a binary64 or midway between two, and so rational. With sqrt(n) irrational the number is
// not rational: its component along sqrt(n) could vanish only if the roots made up for all of c, and then the
// number would not be above 0. With sqrt(n) an integer it is rational only if sqrt(a) and sqrt(b) are
// integers too, because both are subtracted; and integer roots are enclosed by themselves.
double round_rest(const Z& c, const Z& a, const Z& b, const Z& n, long exponent) {
  for (unsigned long bits = 64;; bits *= 2) {
    const auto fine = [bits](const Z& square) { return shifted_left(square, 2 * bits); };
    const Z whole = shifted_left(c, bits);
    const Z low = whole - ceil_sqrt(fine(a)) - ceil_sqrt(fine(b));
    if (low <= 0) continue;
    const Z high = whole - floor_sqrt(fine(a)) - floor_sqrt(fine(b));
    const double least = round_to_binary64({low, 1, 0, ceil_sqrt(fine(n)), exponent});
    if (least == round_to_binary64({high, 1, 0, floor_sqrt(fine(n)), exponent})) return least;
  }
}

}  // namespace lorentz::oracle
