// A scene and a query as integers: all lengths times one power of two, the velocity times another. Private to
// oracle/.
#pragma once

#include <optional>
#include <vector>

#include "dyadic.hpp"
#include "integer.hpp"

namespace lorentz::oracle {

/// A lattice vector or point: Cartesian p, and n, its coordinates in the scene's primitive vectors.
template <std::size_t D>
struct LatticePoint {
  ZVec<D> p;
  ZVec<D> n;

  void add_multiple(const Z& k, const LatticePoint& other) {
    for (std::size_t i = 0; i < D; ++i) {
      mpz_addmul(p[i].get_mpz_t(), k.get_mpz_t(), other.p[i].get_mpz_t());
      mpz_addmul(n[i].get_mpz_t(), k.get_mpz_t(), other.n[i].get_mpz_t());
    }
  }
  void negate() {
    for (std::size_t i = 0; i < D; ++i) {
      p[i] = -p[i];
      n[i] = -n[i];
    }
  }
};

template <std::size_t D>
using Basis = std::array<LatticePoint<D>, D>;

template <std::size_t D>
struct ExactAtom {
  ZVec<D> position;
  Z radius;
};

template <std::size_t D>
struct ExactLattice {
  Basis<D> primitive;  ///< the scene's own vectors
  Basis<D> reduced;    ///< a short basis of the same lattice, shortest vector first
  std::vector<ExactAtom<D>> atoms;
};

/// The scene with every length multiplied by 2^-exponent.
template <std::size_t D>
struct ExactScene {
  long exponent = 0;
  std::vector<ExactLattice<D>> lattices;

  explicit ExactScene(const Scene& scene);
};

/// One atom's obstacles seen from the particle: centres are offset + the lattice, relative to x.
template <std::size_t D>
struct View {
  Basis<D> basis;          ///< reduced
  LatticePoint<D> offset;  ///< the centre in the cell near x, and its coordinates n
  Z radius;
  Z radius2;  ///< radius^2
};

/// The view of an atom from x, all lengths times 2^-exponent (exponent <= the scene's and x's).
template <std::size_t D>
View<D> view_of(const ExactScene<D>& scene, int lattice, int atom, const ZVec<D>& x, long exponent);

/// The same lattice in its own primitive vectors, last one first: for answers in lexicographic order.
template <std::size_t D>
Basis<D> lexicographic_basis(const ExactScene<D>& scene, int lattice, long exponent);

template <std::size_t D>
Z determinant(const Basis<D>& basis);

}  // namespace lorentz::oracle
