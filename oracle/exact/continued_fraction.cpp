#include <lorentz/continued_fraction.hpp>

#include "oracle/exact/quadratic.hpp"
#include "oracle/integers/dyadic.hpp"

namespace lorentz::oracle {
namespace {

// a / b in lowest terms, for b > 0.
std::string fraction(const Z& a, const Z& b) {
  const Z divisor = gcd(a, b), denominator = b / divisor;
  const std::string numerator = Z(a / divisor).get_str();
  return denominator == 1 ? numerator : numerator + "/" + denominator.get_str();
}

}  // namespace

std::vector<Convergent> convergents(double rise, double run, std::size_t limit) {
  CommonExponent common;
  common.see(rise);
  common.see(run);
  Z numerator = scaled(rise, common.get()), denominator = scaled(run, common.get());
  if (denominator < 0) {
    numerator = -numerator;
    denominator = -denominator;
  }
  const Z whole = denominator, height = numerator;
  std::vector<Convergent> result;
  Z p_before = 0, p = 1, q_before = 1, q = 0;
  while (denominator != 0 && result.size() < limit) {
    const Z a = floor_div(numerator, denominator);
    const Z p_next = a * p + p_before, q_next = a * q + q_before;
    p_before = p, p = p_next, q_before = q, q = q_next;
    const Z rest = numerator - a * denominator;
    numerator = denominator;
    denominator = rest;

    const Z remainder = q * height - p * whole;  // over `whole`
    result.push_back({to_integer(a), to_integer(p), to_integer(q),
                      round_to_binary64({remainder, +1, 0, whole, 0}), fraction(remainder, whole)});
  }
  return result;
}

}  // namespace lorentz::oracle
