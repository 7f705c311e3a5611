// Two ellipsoids have no point in common iff a plane with some normal n separates them:
// n.c > sqrt(n.S1 n) + sqrt(n.S2 n), where c is the vector between the centres. The square of the right side
// is the minimum over 0 < t < 1 of n.(S1/(1-t) + S2/t) n, so they are apart iff for some t
//
//   F(t) = c.(S1/(1-t) + S2/t)^-1 c = t (1-t) c.((t S1 + (1-t) S2)^-1) c > 1,
//
// and they touch iff the largest F is 1 (Perram and Wertheim 1985; Wang, Wang and Kim 2001 have the same
// polynomial as det(lambda A + B)). F is concave, with F(0) = F(1) = 0. With lambda = (1-t)/t and
// denominators cleared, F - 1 has the sign of
//
//   g(lambda) = lambda c.adj(S1 + lambda S2) c - (1 + lambda) det(S1 + lambda S2),    lambda > 0,
//
// a polynomial of degree D + 1 with integer coefficients. If it has two positive roots the ellipsoids are
// apart, with one (double) root they touch, and with no positive root they overlap. Sturm's theorem counts
// the roots.
#include "oracle/contacts/ellipsoid_pair.hpp"

#include "oracle/exact/polynomial.hpp"

namespace lorentz::oracle {
namespace {

template <std::size_t D>
using SymmetricMatrix = std::array<std::array<Polynomial, D>, D>;

SymmetricMatrix<2> adjugate_of(const SymmetricMatrix<2>& s) {
  const Polynomial off = Polynomial() - s[0][1];
  return {{{s[1][1], off}, {off, s[0][0]}}};
}

SymmetricMatrix<3> adjugate_of(const SymmetricMatrix<3>& s) {
  SymmetricMatrix<3> adj;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = i; k < 3; ++k) {
      const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      adj[i][k] = adj[k][i] = s[i1][k1] * s[i2][k2] - s[i1][k2] * s[i2][k1];
    }
  return adj;
}

template <std::size_t D>
Polynomial separation(const ZMatrix<D>& s1, const ZMatrix<D>& s2, const ZVec<D>& c) {
  SymmetricMatrix<D> pencil;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t k = 0; k < D; ++k) pencil[i][k] = {s1[i][k], s2[i][k]};
  const SymmetricMatrix<D> adj = adjugate_of(pencil);
  Polynomial form, determinant;
  for (std::size_t i = 0; i < D; ++i) {
    determinant = determinant + pencil[0][i] * adj[i][0];
    for (std::size_t k = 0; k < D; ++k) form = form + Polynomial{c[i] * c[k]} * adj[i][k];
  }
  return Polynomial{0, 1} * form - Polynomial{1, 1} * determinant;
}

// The number of different positive roots of p; p(0) must not be zero.
int positive_roots(const Polynomial& p) {
  const std::vector<Polynomial> chain = remainders(p, derivative(p));
  return sign_changes(chain, [](const Polynomial& each) { return sgn(each[0]); }) -
         sign_changes(chain, [](const Polynomial& each) { return sgn(each.back()); });
}

}  // namespace

template <std::size_t D>
Relation relation_of(const ZMatrix<D>& s1, const ZMatrix<D>& s2, const ZVec<D>& c) {
  const int roots = positive_roots(separation<D>(s1, s2, c));
  return roots == 0 ? Relation::overlap : roots == 1 ? Relation::touch : Relation::apart;
}

template Relation relation_of(const ZMatrix<2>&, const ZMatrix<2>&, const ZVec<2>&);
template Relation relation_of(const ZMatrix<3>&, const ZMatrix<3>&, const ZVec<3>&);

}  // namespace lorentz::oracle
