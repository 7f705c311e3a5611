// Exact lattice reduction in two and three dimensions under any positive definite integer form: Lagrange's
// algorithm, and in 3D the greedy one (Nguyen and Stehle, "Low-dimensional lattice basis reduction
// revisited"). The result is always a basis of the same lattice; a worse basis costs time, never correctness.
// Private to oracle/.
//
// A vector is any type with add_multiple(k, other); a form maps two vectors to their inner product.
#pragma once

#include <utility>

#include "oracle/exact/exact_problem.hpp"

namespace lorentz::oracle {

/// a.b
inline constexpr auto euclidean_form = [](const auto& a, const auto& b) { return dot(a.p, b.p); };

/// Makes b1, b2 a shortest pair: |b1| <= |b2| and 2 |b1.b2| <= |b1|^2. Takes and updates their inner
/// products.
template <class Vector>
void reduce_pair(Vector& b1, Vector& b2, Z& g11, Z& g12, Z& g22) {
  for (;;) {
    if (g22 < g11) {
      std::swap(b1, b2);
      std::swap(g11, g22);
    }
    const Z k = round_div(g12, g11);
    if (k == 0) return;
    b2.add_multiple(-k, b1);
    g22 += k * (k * g11 - 2 * g12);
    g12 -= k * g11;
    if (g22 >= g11) return;
  }
}

template <class Vector, class Form>
void reduce(std::array<Vector, 2>& basis, const Form& form) {
  Z g11 = form(basis[0], basis[0]), g12 = form(basis[0], basis[1]), g22 = form(basis[1], basis[1]);
  reduce_pair(basis[0], basis[1], g11, g12, g22);
}

/// Orders the basis by length and makes each vector short relative to those before it.
template <class Vector, class Form>
void reduce(std::array<Vector, 3>& basis, const Form& form) {
  auto& [b1, b2, b3] = basis;
  Z g11 = form(b1, b1), g22 = form(b2, b2), g33 = form(b3, b3);
  for (;;) {
    // Put the longest last.
    if (g33 < g11) std::swap(b1, b3), std::swap(g11, g33);
    if (g33 < g22) std::swap(b2, b3), std::swap(g22, g33);
    Z g12 = form(b1, b2);
    reduce_pair(b1, b2, g11, g12, g22);
    if (g33 < g22) continue;  // the pair is short now: b3 may belong to it
    // Subtract from b3 the combination of b1 and b2 nearest to it, by rounding its real coordinates.
    const Z g13 = form(b1, b3), g23 = form(b2, b3), det = g11 * g22 - g12 * g12;
    const Z k1 = round_div(g13 * g22 - g23 * g12, det), k2 = round_div(g23 * g11 - g13 * g12, det);
    const Z shorter = g33 + k1 * (k1 * g11 - 2 * g13) + k2 * (k2 * g22 - 2 * g23) + 2 * k1 * k2 * g12;
    if (shorter >= g33) return;
    b3.add_multiple(-k1, b1);
    b3.add_multiple(-k2, b2);
    g33 = shorter;
    if (g33 >= g22) return;
  }
}

}  // namespace lorentz::oracle
