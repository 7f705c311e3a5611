// The problem of a certificate in integers: flights as each atom sees them. Private to certificate_check.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include <lorentz/certificate.hpp>
#include <lorentz/scene.hpp>
#include "oracle/certificate/check/certificate_time.hpp"
#include "oracle/integers/dyadic.hpp"

namespace lorentz::oracle::certificate {

/// Thrown by whatever finds the proof wanting; the callers put in front where that was.
struct Refuted {
  std::string why;
};

[[noreturn]] inline void refute(std::string why) {
  throw Refuted{std::move(why)};
}

inline std::string name_of(int lattice, int atom) {
  return "lattice " + std::to_string(lattice) + ", atom " + std::to_string(atom);
}

template <std::size_t D>
std::string name_of(int lattice, int atom, const ZVec<D>& n) {
  std::string cell;
  for (const Z& component : n) cell += (cell.empty() ? "" : ", ") + component.get_str();
  return "obstacle (" + name_of(lattice, atom) + ", cell [" + cell + "])";
}

// ---- Integers

template <std::size_t D>
using ZMatrix = std::array<ZVec<D>, D>;  // rows

inline Z determinant(const ZMatrix<2>& m) {
  return cross(m[0], m[1]);
}

inline Z determinant(const ZMatrix<3>& m) {
  return dot(m[0], cross(m[1], m[2]));
}

/// adj(A) = det(A) A^-1 of the matrix with these columns.
inline ZMatrix<2> adjugate(const ZMatrix<2>& a) {
  return {ZVec<2>{a[1][1], Z(-a[1][0])}, ZVec<2>{Z(-a[0][1]), a[0][0]}};
}

inline ZMatrix<3> adjugate(const ZMatrix<3>& a) {
  return {cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1])};
}

template <std::size_t D>
ZVec<D> operator*(const ZMatrix<D>& m, const ZVec<D>& a) {
  ZVec<D> product;
  for (std::size_t i = 0; i < D; ++i) product[i] = dot(m[i], a);
  return product;
}

/// k_1 b_1 + .. + k_d b_d.
template <std::size_t D>
ZVec<D> combination(const ZVec<D>& k, const ZMatrix<D>& b) {
  ZVec<D> sum;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t j = 0; j < D; ++j) sum[j] += k[i] * b[i][j];
  return sum;
}

template <std::size_t D>
ZVec<D> sum(const ZVec<D>& a, const Z& k, const ZVec<D>& b) {
  ZVec<D> result;
  for (std::size_t i = 0; i < D; ++i) result[i] = a[i] + k * b[i];
  return result;
}

template <std::size_t D>
ZVec<D> shifted(ZVec<D> a, unsigned long bits) {
  for (Z& component : a) component = shifted_left(component, bits);
  return a;
}

// ---- The problem in integers

/// The first D components times 2^-exponent.
template <std::size_t D>
ZVec<D> scaled_vec(const Vec& a, long exponent) {
  ZVec<D> result;
  for (std::size_t i = 0; i < D; ++i) result[i] = scaled(a[i], exponent);
  return result;
}

template <std::size_t D>
void see(CommonExponent& exponent, const Vec& a) {
  for (std::size_t i = 0; i < D; ++i) exponent.see(a[i]);
}

/// An atom and its lattice in the atom's own coordinates, lengths in units of 2^exponent. For an ellipsoid {
/// p + A y : |y| < 1 } these are multiplied by adj(A), which makes a ball of the radius |det(A)| of it; A in
/// units of 2^axes.
template <std::size_t D>
struct Body {
  std::optional<ZMatrix<D>> to_ball;
  ZMatrix<D> u;
  ZVec<D> p;
  Z r;
  long axes;

  Body(const Lattice& lattice, const Atom& atom, long exponent) {
    for (std::size_t i = 0; i < D; ++i) u[i] = scaled_vec<D>(lattice.vectors[i], exponent);
    if (determinant(u) == 0) refute("the primitive vectors are dependent");
    p = scaled_vec<D>(atom.position, exponent);
    axes = exponent;
    if (atom.is_ball()) {
      r = scaled(atom.radius, exponent);
      return;
    }
    CommonExponent own;
    for (const Vec& axis : atom.semiaxes) see<D>(own, axis);
    axes = own.get();
    ZMatrix<D> a;
    for (std::size_t i = 0; i < D; ++i) a[i] = scaled_vec<D>(atom.semiaxes[i], axes);
    r = abs(determinant(a));
    if (r == 0) refute("the semiaxes are dependent");
    to_ball = adjugate(a);
    for (ZVec<D>& vector : u) vector = *to_ball * vector;
    p = *to_ball * p;
  }

  ZVec<D> in_own_coordinates(const ZVec<D>& a) const { return to_ball ? *to_ball * a : a; }

  /// What in_own_coordinates has to be multiplied with, and r, where all numbers are in units of 2^unit, in
  /// bits.
  unsigned long bits_of_coordinates(long unit) const {
    return to_ball ? (D - 1) * static_cast<unsigned long>(axes - unit) : 0;
  }
  unsigned long bits_of_radius(long unit) const {
    return (to_ball ? D : 1) * static_cast<unsigned long>(axes - unit);
  }
};

/// A flight as an atom sees it.
template <std::size_t D>
struct CertificateView {
  int lattice, atom;
  ZMatrix<D> u;  // the lattice
  ZVec<D> w0;    // the obstacle of cell 0, seen from the start
  ZVec<D> v;
  Z v2, rho2;  // v^2, r^2 v^2

  /// v^2 a.b - (v.a)(v.b) = (v x a).(v x b), for s_a = v.a and s_b = v.b.
  Z across(const ZVec<D>& a, const Z& s_a, const ZVec<D>& b, const Z& s_b) const {
    return v2 * dot(a, b) - s_a * s_b;
  }
};

/// A certificate's basis: the rows in coordinates n, and as they stand in the atom's coordinates.
template <std::size_t D>
struct Basis {
  ZMatrix<D> n, b;
};

inline Z read_integer(const Integer& a, std::size_t longest = kLongestText) {
  if (!a.fits_int64() && a.decimal().size() > longest)
    refute("holds an integer of more than " + std::to_string(longest) + " characters");
  return to_z(a);
}

template <std::size_t D>
ZVec<D> read_cell(const Cell& cell) {
  for (std::size_t i = D; i < 3; ++i)
    if (!(cell[i] == Integer(0))) refute("holds a third coordinate in two dimensions");
  ZVec<D> n;
  for (std::size_t i = 0; i < D; ++i) n[i] = read_integer(cell[i]);
  return n;
}

template <std::size_t D>
Basis<D> read_basis(const CertificateBasis& given, const CertificateView<D>& view) {
  for (std::size_t i = D; i < 3; ++i)
    for (const Integer& component : given[i])
      if (!(component == Integer(0))) refute("holds a third vector in two dimensions");
  Basis<D> basis;
  for (std::size_t i = 0; i < D; ++i) basis.n[i] = read_cell<D>(given[i]);
  if (abs(determinant(basis.n)) != 1) refute("the determinant of the basis is not +-1");
  for (std::size_t i = 0; i < D; ++i) basis.b[i] = combination(basis.n[i], view.u);
  return basis;
}

}  // namespace lorentz::oracle::certificate
