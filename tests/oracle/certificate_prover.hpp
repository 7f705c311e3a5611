// A plain prover of answers, for tests of the check alone: reduces bases in floating point, in the metric in
// which the window is a ball. What it returns need not be a proof; the check decides.
#pragma once

#include <lorentz/certificate.hpp>
#include "oracle/integers/dyadic.hpp"
#include "tests/support/support.hpp"

namespace lorentz::test {

using Real = long double;
using RealVec = std::array<Real, 3>;

inline Real dot(const RealVec& a, const RealVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline RealVec cross(const RealVec& a, const RealVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// a in the coordinates in which the atom is a ball of radius 1.
inline RealVec in_ball(const Atom& atom, int dimension, const Vec& a) {
  const RealVec real{a[0], a[1], a[2]};
  if (atom.is_ball()) return {real[0] / atom.radius, real[1] / atom.radius, real[2] / atom.radius};
  std::array<RealVec, 3> axes{RealVec{}, RealVec{}, RealVec{0, 0, 1}};
  for (int i = 0; i < dimension; ++i)
    for (int k = 0; k < 3; ++k) axes[i][k] = atom.semiaxes[i][k];
  const Real det = dot(axes[0], cross(axes[1], axes[2]));
  RealVec result{};
  for (int i = 0; i < dimension; ++i)
    result[i] = dot(cross(axes[(i + 1) % 3], axes[(i + 2) % 3]), real) / det;
  return result;
}

/// A lattice vector in a metric, and its coordinates.
struct Metric {
  std::array<std::int64_t, 3> n{};
  RealVec z{};

  void subtract(Real k, const Metric& other) {
    for (int i = 0; i < 3; ++i) {
      n[i] -= static_cast<std::int64_t>(k) * other.n[i];
      z[i] -= k * other.z[i];
    }
  }
  Real norm() const { return dot(z, z); }
};

/// Each vector is reduced by all others until none gets shorter; in the order of length.
inline void reduce(std::vector<Metric>& basis) {
  for (bool shorter = true; shorter;) {
    shorter = false;
    for (Metric& b : basis)
      for (const Metric& other : basis) {
        if (&b == &other) continue;
        const Real k = std::round(dot(b.z, other.z) / other.norm());
        if (!(std::fabs(k) < 0x1p40L)) continue;  // no number, or too large: leave it
        Metric next = b;
        next.subtract(k, other);
        if (k != 0 && next.norm() < b.norm() * (1 - 1e-9L)) b = next, shorter = true;
      }
  }
  std::sort(basis.begin(), basis.end(), [](const Metric& a, const Metric& b) { return a.norm() < b.norm(); });
}

/// A basis of the lattice that suits a window of this length in t.
inline oracle::CertificateBasis basis_for(const Scene& scene, int l, int a, const Vec& velocity,
                                          double length) {
  const int d = scene.dimension;
  const Lattice& lattice = scene.lattices[l];
  const RealVec v = in_ball(lattice.atoms[a], d, velocity);
  const Real v2 = dot(v, v), half = std::sqrt(v2) * length / 2;
  std::vector<Metric> basis(d);
  std::vector<RealVec> plain(d);
  for (int i = 0; i < d; ++i) {
    basis[i].n[i] = 1;
    basis[i].z = plain[i] = in_ball(lattice.atoms[a], d, lattice.vectors[i]);
    const Real along = dot(basis[i].z, v) / v2;
    for (int k = 0; k < 3; ++k) basis[i].z[k] += (1 / half - 1) * along * v[k];
  }
  reduce(basis);
  if (d == 3) {  // b_1 x b_2 along v is not accepted
    std::array<RealVec, 2> b{};
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < d; ++i)
        for (int k = 0; k < 3; ++k) b[j][k] += static_cast<Real>(basis[j].n[i]) * plain[i][k];
    const RealVec normal = cross(b[0], b[1]), e = cross(v, normal);
    if (dot(e, e) < 1e-24L * v2 * dot(normal, normal)) std::swap(basis[1], basis[2]);
  }
  oracle::CertificateBasis result;
  for (int i = 0; i < d; ++i)
    for (int k = 0; k < d; ++k) result[i][k] = Integer(basis[i].n[k]);
  return result;
}

/// An atom's windows for -r/|v| <= T <= time + r/|v|, and a little more.
inline void append_windows(oracle::Certificate& proof, const Scene& scene, int l, int a, const Vec& velocity,
                           double time, int pieces) {
  const RealVec v = in_ball(scene.lattices[l].atoms[a], scene.dimension, velocity);
  const double reach = static_cast<double>(1 / std::sqrt(dot(v, v)));
  const double from = -reach * (1 + 1e-9), to = (time + reach) * (1 + 1e-9);
  for (int i = 0; i < pieces; ++i) {
    const double begin = from + (to - from) * i / pieces;
    const double end = i + 1 == pieces ? to : from + (to - from) * (i + 1) / pieces;
    proof.windows.push_back({l, a, begin, end, basis_for(scene, l, a, velocity, end - begin)});
  }
}

/// A lattice and a direction in integers; a flat one as the plane of a solid one.
struct IntegerLattice {
  std::array<oracle::ZVec<3>, 3> u;
  oracle::ZVec<3> v;

  IntegerLattice(const Lattice& lattice, int dimension, const Vec& velocity) {
    oracle::CommonExponent lengths, velocities;
    for (int k = 0; k < dimension; ++k) {
      velocities.see(velocity[k]);
      for (int i = 0; i < dimension; ++i) lengths.see(lattice.vectors[i][k]);
    }
    u[2][2] = 1;
    for (int k = 0; k < dimension; ++k) {
      v[k] = oracle::scaled(velocity[k], velocities.get());
      for (int i = 0; i < dimension; ++i) u[i][k] = oracle::scaled(lattice.vectors[i][k], lengths.get());
    }
  }

  /// The shortest lattice vector along v, in coordinates n: these are in proportion those of v in the basis
  /// u.
  oracle::ZVec<3> parallel() const {
    oracle::ZVec<3> n;
    oracle::Z common = 0;
    for (int i = 0; i < 3; ++i) {
      n[i] = oracle::dot(v, oracle::cross(u[(i + 1) % 3], u[(i + 2) % 3]));
      common = gcd(common, n[i]);
    }
    for (oracle::Z& component : n) component /= common;
    return n;
  }

  /// v x (n_1 u_1 + n_2 u_2 + n_3 u_3).
  oracle::ZVec<3> across(const oracle::ZVec<3>& n) const {
    oracle::ZVec<3> w;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) w[k] += n[i] * u[i][k];
    return oracle::cross(v, w);
  }

  /// Makes two vectors short across v, as for a ball.
  void reduce_across(oracle::ZVec<3>& a, oracle::ZVec<3>& b) const {
    for (;;) {
      oracle::ZVec<3> ha = across(a), hb = across(b);
      if (oracle::dot(ha, ha) > oracle::dot(hb, hb)) std::swap(a, b), std::swap(ha, hb);
      const oracle::Z k = oracle::round_div(oracle::dot(ha, hb), oracle::dot(ha, ha));
      if (k == 0) return;
      for (int i = 0; i < 3; ++i) b[i] -= k * a[i];
      const oracle::ZVec<3> next = across(b);
      if (oracle::dot(next, next) >= oracle::dot(hb, hb)) return;
    }
  }
};

/// x and y with x a + y b = g, the greatest common divisor.
struct Bezout {
  oracle::Z g, x, y;

  Bezout(const oracle::Z& a, const oracle::Z& b) {
    const oracle::Bezout one = oracle::bezout(a, b);
    g = one.gcd, x = one.x, y = one.y;
  }
};

/// Rows along v: the vector along v, completed to a basis.
inline oracle::CertificateBasis rows_along(const Lattice& lattice, int dimension, const Vec& v) {
  using oracle::Z, oracle::ZVec;
  const IntegerLattice exact(lattice, dimension, v);
  std::array<ZVec<3>, 3> b{exact.parallel()};
  const ZVec<3>& n = b[0];
  const Bezout two(n[0], n[1]), three(two.g, n[2]);
  if (dimension == 2) {
    b[1] = {Z(-two.y), two.x, Z(0)};
  } else if (two.g == 0) {
    b[1][0] = b[2][1] = 1;
  } else {
    const Z p = n[0] / two.g, q = n[1] / two.g;
    // (p, q, 0) and (-y, x, 0) span the plane n_3 = 0, since p x + q y = 1; and b_1 lies in that of (p, q, 0)
    // and (0, 0, 1).
    b[1] = {Z(-two.y), two.x, Z(0)};
    b[2] = {Z(-three.y * p), Z(-three.y * q), three.x};
  }
  if (dimension == 3) exact.reduce_across(b[1], b[2]);
  oracle::CertificateBasis result;
  for (int i = 0; i < dimension; ++i)
    for (int k = 0; k < dimension; ++k) result[i][k] = oracle::to_integer(b[i][k]);
  return result;
}

inline oracle::Certificate proof_of(const Scene& scene, const Query& query, const Answer& answer,
                                    int pieces = 1) {
  oracle::Certificate proof;
  const ObstacleId& last = answer.obstacle;
  for (int l = 0; l < static_cast<int>(scene.lattices.size()); ++l)
    for (int a = 0; a < static_cast<int>(scene.lattices[l].atoms.size()); ++a) {
      if (answer.outcome == Outcome::never)
        proof.rows.push_back({l, a, rows_along(scene.lattices[l], scene.dimension, query.v)});
      else if (answer.outcome == Outcome::hit || std::pair(l, a) <= std::pair(last.lattice, last.atom))
        append_windows(proof, scene, l, a, query.v, answer.time.value_or(0), pieces);
    }
  return proof;
}

}  // namespace lorentz::test
