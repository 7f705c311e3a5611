// Exact lattice reduction in two and three dimensions under any positive (semi)definite integer form:
// Lagrange's algorithm, and in 3D the greedy one (Nguyen and Stehle, "Low-dimensional lattice basis reduction
// revisited"). Whatever it returns is a basis of the same lattice; a worse basis costs time, never
// correctness. Private to oracle/.
#pragma once

#include <algorithm>
#include <utility>

#include "exact_problem.hpp"

namespace lorentz::oracle {

/// |p|^2.
template <std::size_t D>
struct EuclideanForm {
  Z operator()(const LatticePoint<D>& a, const LatticePoint<D>& b) const { return dot(a.p, b.p); }
};

/// Makes b1, b2 a shortest pair: |b1| <= |b2|, 2 |b1.b2| <= |b1|^2. A vector of zero length comes first and
/// ends it.
template <class Point, class Form>
void reduce_pair(Point& b1, Point& b2, const Form& form) {
  Z g11 = form(b1, b1), g22 = form(b2, b2), g12 = form(b1, b2);
  for (;;) {
    if (g22 < g11) {
      std::swap(b1, b2);
      std::swap(g11, g22);
    }
    if (g11 == 0) return;
    const Z k = round_div(g12, g11);
    if (k == 0) return;
    b2.add_multiple(-k, b1);
    g22 += k * (k * g11 - 2 * g12);
    g12 -= k * g11;
    if (g22 >= g11) return;
  }
}

template <class Form>
void reduce(Basis<2>& basis, const Form& form) {
  reduce_pair(basis[0], basis[1], form);
}

/// Orders the basis by length and makes each vector short against those before it.
template <class Form>
void reduce(Basis<3>& basis, const Form& form) {
  for (;;) {
    std::sort(basis.begin(), basis.end(),
              [&](const auto& a, const auto& b) { return form(a, a) < form(b, b); });
    reduce_pair(basis[0], basis[1], form);
    const Z g22 = form(basis[1], basis[1]), g33 = form(basis[2], basis[2]);
    if (g33 < g22) continue;
    // Take from b3 the combination of b1 and b2 nearest to it, by rounding its real coordinates.
    const Z g11 = form(basis[0], basis[0]), g12 = form(basis[0], basis[1]);
    const Z g13 = form(basis[0], basis[2]), g23 = form(basis[1], basis[2]);
    const Z det = g11 * g22 - g12 * g12;
    if (det == 0) return;
    const Z k1 = round_div(g13 * g22 - g23 * g12, det), k2 = round_div(g23 * g11 - g13 * g12, det);
    if (k1 == 0 && k2 == 0) return;
    LatticePoint<3> shorter = basis[2];
    shorter.add_multiple(-k1, basis[0]);
    shorter.add_multiple(-k2, basis[1]);
    const Z after = form(shorter, shorter);
    if (after >= g33) return;
    basis[2] = std::move(shorter);
    if (after >= g22) return;
  }
}

}  // namespace lorentz::oracle
