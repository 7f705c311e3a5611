// Integers of any size, and the few operations on them that the oracle is made of. Private to oracle/.
#pragma once

#include <gmpxx.h>

#include <array>

#include <lorentz/problem.hpp>

namespace lorentz::oracle {

using Z = mpz_class;

template <std::size_t D>
using ZVec = std::array<Z, D>;

/// Largest integer <= a / b, for any b != 0.
inline Z floor_div(const Z& a, const Z& b) {
  Z q;
  mpz_fdiv_q(q.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  return q;
}

/// Smallest integer >= a / b, for any b != 0.
inline Z ceil_div(const Z& a, const Z& b) {
  Z q;
  mpz_cdiv_q(q.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  return q;
}

/// An integer nearest to a / b, for b > 0.
inline Z round_div(const Z& a, const Z& b) {
  return floor_div(2 * a + b, 2 * b);
}

/// floor(sqrt(a)), for a >= 0.
inline Z floor_sqrt(const Z& a) {
  Z root;
  mpz_sqrt(root.get_mpz_t(), a.get_mpz_t());
  return root;
}

/// Smallest integer whose square is >= a, for a >= 0.
inline Z ceil_sqrt(const Z& a) {
  Z root, rest;
  mpz_sqrtrem(root.get_mpz_t(), rest.get_mpz_t(), a.get_mpz_t());
  if (rest != 0) ++root;
  return root;
}

/// Largest integer whose square is < a, for a >= 1.
inline Z root_below(const Z& a) {
  return floor_sqrt(a - 1);
}

inline Z shifted_left(const Z& a, unsigned long bits) {
  Z result;
  mpz_mul_2exp(result.get_mpz_t(), a.get_mpz_t(), bits);
  return result;
}

/// Number of bits of |a|; 0 for a = 0.
inline long bit_length(const Z& a) {
  return a == 0 ? 0 : static_cast<long>(mpz_sizeinbase(a.get_mpz_t(), 2));
}

/// floor((a + sign * sqrt(d)) / q), for d >= 0 and q > 0; sign is +1 or -1. Exact: floor(y / q) =
/// floor(floor(y) / q).
inline Z floor_surd(const Z& a, int sign, const Z& d, const Z& q) {
  return floor_div(sign > 0 ? Z(a + floor_sqrt(d)) : Z(a - ceil_sqrt(d)), q);
}

template <std::size_t D>
Z dot(const std::array<Z, D>& a, const std::array<Z, D>& b) {
  Z sum = a[0] * b[0];
  for (std::size_t i = 1; i < D; ++i) mpz_addmul(sum.get_mpz_t(), a[i].get_mpz_t(), b[i].get_mpz_t());
  return sum;
}

inline Z cross(const ZVec<2>& a, const ZVec<2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

inline ZVec<3> cross(const ZVec<3>& a, const ZVec<3>& b) {
  return {Z(a[1] * b[2] - a[2] * b[1]), Z(a[2] * b[0] - a[0] * b[2]), Z(a[0] * b[1] - a[1] * b[0])};
}

inline Z to_z(const Integer& a) {
  if (!a.fits_int64()) return Z(a.decimal(), 10);
  static_assert(sizeof(long) == 8, "64-bit long expected");
  return Z(static_cast<long>(a.int64()));
}

inline Integer to_integer(const Z& a) {
  if (a.fits_slong_p()) return Integer(a.get_si());
  return *Integer::from_decimal(a.get_str());
}

}  // namespace lorentz::oracle
