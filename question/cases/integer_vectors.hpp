// Small integer vectors, and the tools of exact constructions: Bezout's identity, squares, Pell's equation. A
// 2D vector has a third component 0.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <lorentz/geometry.hpp>
#include <lorentz/obstacle.hpp>
#include "question/cases/random.hpp"

namespace lorentz::cases {

using IntVec = std::array<std::int64_t, 3>;
using Wide = WideInteger;

using lorentz::cross;  // of Vec, beside those of IntVec
using lorentz::dot;

inline std::int64_t dot(const IntVec& a, const IntVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline IntVec cross(const IntVec& a, const IntVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The obstacle of lattice 0 with this atom in the cell.
inline ObstacleId obstacle(const IntVec& cell, int atom = 0) {
  return {0, atom, {Integer(cell[0]), Integer(cell[1]), Integer(cell[2])}};
}

/// The greatest common divisor of the components; 0 for the zero vector.
std::int64_t content_of(const IntVec& a);

/// u with u.a = content_of(a); in 2D, u is 2D.
IntVec bezout(const IntVec& a);

/// a divided by its content, which must not be 0.
IntVec primitive(IntVec a);

/// A drawn vector with components from -range to range, and a primitive one.
IntVec drawn_integers(Random& random, int dimension, std::int64_t range);
IntVec drawn_primitive(Random& random, int dimension, std::int64_t range);

/// Two independent primitive vectors at right angles to n.
std::array<IntVec, 2> across_of(const IntVec& n);

/// a_1 u_1 + a_2 u_2 (+ a_3 u_3), in binary64.
Vec cartesian(const Lattice& lattice, const IntVec& a);
Vec to_vec(const IntVec& a);

/// Half the width of the corridor along the primitive lattice vector (2D), or of the channel between the
/// lattice planes (3D), with these indices, if the obstacles were points.
double half_width(const Lattice& lattice, int dimension, const IntVec& indices);

/// An integer vector v of integer length w, and `across`, one of the same length at a right angle to it (2D:
/// across = (0, 0, w) stands for the side on which the line passes).
struct Squared {
  IntVec v, across;
  std::int64_t length;
};

/// From a Pythagorean triple (a^2 - b^2, 2ab, a^2 + b^2), a up to `range`; primitive.
Squared drawn_triple(Random& random, std::int64_t range);

/// The rotation matrix of a quaternion times its norm: rows and columns are orthogonal and of that length.
std::array<IntVec, 3> rotation_of(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d);

/// From a quaternion with components up to `range`: two rows of its matrix. v is primitive.
Squared drawn_quadruple(Random& random, std::int64_t range);

/// Primitive v in the plane with |v|^2 = w^2 + 1 or w^2 - 1, w below a bound.
struct NearSquare {
  IntVec v;
  std::int64_t w;
};
NearSquare drawn_near_square(Random& random, std::int64_t below);

/// Convergents k / r of sqrt(n / h), r up to 2^bits (bits at most 50). n r^2 - h k^2 is as small as possible,
/// so r and k solve Pell's equation or nearly. Ends early if the root is rational.
struct IntegerRatio {
  std::int64_t k, r;
};
std::vector<IntegerRatio> convergents_of_root(std::int64_t n, std::int64_t h, int bits);

/// The start x from which the flight along the primitive v passes the origin at its closest point after the
/// distance `along` or a little more, with v x (0 - x) = `turns` 2^-exponent `across` exactly. `across` must
/// be at right angles to v (2D: a multiple of (0, 0, 1)). Nothing if no vector with numbers of that precision
/// does that near there.
std::optional<Vec> start_beside(const IntVec& v, const IntVec& across, std::int64_t turns, int exponent,
                                double along, int bits);

}  // namespace lorentz::cases
