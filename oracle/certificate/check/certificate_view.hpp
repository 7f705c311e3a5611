// The problem of a certificate in integers: a flight as each atom sees it. Private to certificate_check.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include <lorentz/certificate.hpp>
#include <lorentz/scene.hpp>
#include "oracle/certificate/check/certificate_time.hpp"
#include "oracle/integers/dyadic.hpp"

namespace lorentz::oracle::certificate {

/// Thrown by every function that finds a fault in the proof; the callers put its place in front.
struct Refuted {
  std::string why;
  bool too_long = false;  ///< right or not: it takes more steps than are allowed
};

[[noreturn]] inline void refute(std::string why) {
  throw Refuted{std::move(why)};
}

inline std::string name_of(int lattice, int atom) {
  return "lattice " + std::to_string(lattice) + ", atom " + std::to_string(atom);
}

inline std::string name_of(int lattice, int atom, std::span<const Z> n) {
  std::string cell;
  for (const Z& component : n) cell += (cell.empty() ? "" : ", ") + component.get_str();
  return "obstacle (" + name_of(lattice, atom) + ", cell [" + cell + "])";
}

// ---- Integers. A planar scene is the plane z = 0 of a spatial one, and its discs are the equators of balls.
// A lattice of k vectors is one of three vectors that uses the first k coordinates n.

using ZVec3 = ZVec<3>;
using ZMatrix = std::array<ZVec3, 3>;  // rows

inline Z determinant(const ZMatrix& m) {
  return dot(m[0], cross(m[1], m[2]));
}

/// True if the first k rows, k <= 3, are linearly independent.
inline bool independent(const ZMatrix& m, int k) {
  if (k == 0) return true;
  if (k == 3) return determinant(m) != 0;
  return (k == 1 ? m[0] : cross(m[0], m[1])) != ZVec3{};
}

/// adj(A) = det(A) A^-1 of the matrix with these columns.
inline ZMatrix adjugate(const ZMatrix& a) {
  return {cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1])};
}

inline ZVec3 operator*(const ZMatrix& m, const ZVec3& a) {
  return {dot(m[0], a), dot(m[1], a), dot(m[2], a)};
}

inline ZVec3 sum(const ZVec3& a, const Z& k, const ZVec3& b) {
  return {a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]};
}

/// k_1 b_1 + k_2 b_2 + k_3 b_3.
inline ZVec3 combination(const ZVec3& k, const ZMatrix& b) {
  return sum(sum(sum({}, k[0], b[0]), k[1], b[1]), k[2], b[2]);
}

inline ZVec3 shifted(ZVec3 a, unsigned long bits) {
  for (Z& component : a) component = shifted_left(component, bits);
  return a;
}

// ---- The problem in integers

/// The vector times 2^-exponent.
inline ZVec3 scaled_vec(const Vec& a, long exponent) {
  return {scaled(a[0], exponent), scaled(a[1], exponent), scaled(a[2], exponent)};
}

inline void see(CommonExponent& exponent, const Vec& a) {
  for (const double component : a) exponent.see(component);
}

/// An atom and its lattice in the atom's own coordinates, with lengths in units of 2^exponent. For an
/// ellipsoid { p + A y : |y| < 1 } they are multiplied by adj(A), which maps it to a ball of radius |det(A)|.
/// A is in units of 2^axes, and in the plane its third semiaxis is (0, 0, 1).
struct Body {
  int rank;
  std::optional<ZMatrix> to_ball;
  ZMatrix u;
  ZVec3 p;
  Z r;
  long axes;

  Body(int dimension, const Lattice& lattice, const Atom& atom, long exponent)
      : rank(lattice.rank_in(dimension)), axes(exponent), dimension_(static_cast<unsigned long>(dimension)) {
    for (std::size_t i = 0; i < 3; ++i) u[i] = scaled_vec(lattice.vectors[i], exponent);
    if (!independent(u, rank)) refute("the primitive vectors are dependent");
    p = scaled_vec(atom.position, exponent);
    if (atom.is_ball()) {
      r = scaled(atom.radius, exponent);
      return;
    }
    CommonExponent own;
    for (const Vec& axis : atom.semiaxes) see(own, axis);
    axes = own.get();
    ZMatrix a{ZVec3{}, ZVec3{}, ZVec3{0, 0, 1}};
    for (std::size_t i = 0; i < atom.semiaxes.size(); ++i) a[i] = scaled_vec(atom.semiaxes[i], axes);
    r = abs(determinant(a));
    if (r == 0) refute("the semiaxes are dependent");
    to_ball = adjugate(a);
    for (ZVec3& vector : u) vector = *to_ball * vector;
    p = *to_ball * p;
  }

  ZVec3 in_own_coordinates(const ZVec3& a) const { return to_ball ? *to_ball * a : a; }

  /// Numbers of bits by which in_own_coordinates and r must be shifted left if all numbers are in units of
  /// 2^unit.
  unsigned long bits_of_coordinates(long unit) const {
    return to_ball ? (dimension_ - 1) * static_cast<unsigned long>(axes - unit) : 0;
  }
  unsigned long bits_of_radius(long unit) const {
    return (to_ball ? dimension_ : 1) * static_cast<unsigned long>(axes - unit);
  }

 private:
  unsigned long dimension_;
};

/// A flight as an atom sees it.
struct CertificateView {
  int lattice, atom, rank;
  ZMatrix u;  // vectors of the lattice
  ZVec3 w0;   // the obstacle of cell 0, relative to the start
  ZVec3 v;
  Z v2, rho2;  // v^2, r^2 v^2

  /// v^2 a.b - (v.a)(v.b) = (v x a).(v x b), for s_a = v.a and s_b = v.b.
  Z across(const ZVec3& a, const Z& s_a, const ZVec3& b, const Z& s_b) const {
    return v2 * dot(a, b) - s_a * s_b;
  }
};

/// A certificate's basis: its rows in coordinates n, and in the atom's coordinates.
struct Basis {
  ZMatrix n, b;
};

inline Z read_integer(const Integer& a, std::size_t longest = kLongestText) {
  if (!a.fits_int64() && a.decimal().size() > longest)
    refute("holds an integer of more than " + std::to_string(longest) + " characters");
  return to_z(a);
}

/// Reads `rank` coordinates.
inline ZVec3 read_cell(const Cell& cell, int rank) {
  ZVec3 n;
  for (int i = 0; i < 3; ++i) {
    if (i >= rank && !(cell[i] == Integer(0)))
      refute("holds more than the lattice's " + std::to_string(rank) + " coordinates");
    n[i] = read_integer(cell[i]);
  }
  return n;
}

/// Reads the first `rank` rows and completes them.
inline Basis read_basis(const CertificateBasis& given, const CertificateView& view) {
  Basis basis{{ZVec3{1, 0, 0}, ZVec3{0, 1, 0}, ZVec3{0, 0, 1}}, {}};
  for (int i = 0; i < 3; ++i)
    if (i < view.rank)
      basis.n[i] = read_cell(given[i], view.rank);
    else if (given[i] != Cell{})
      refute("holds more than the lattice's " + std::to_string(view.rank) + " vectors");
  if (abs(determinant(basis.n)) != 1) refute("the determinant of the basis is not +-1");
  for (int i = 0; i < 3; ++i) basis.b[i] = combination(basis.n[i], view.u);
  return basis;
}

}  // namespace lorentz::oracle::certificate
