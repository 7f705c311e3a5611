// The lattice planes and rows that meet a stretch of a cylinder around the line of flight, in 3D. The bounds
// are exact, rounded outwards, and hold in any basis. Private to oracle/.
#pragma once

#include <utility>

#include "oracle/exact/exact_problem.hpp"

namespace lorentz::oracle {

/// A lattice vector, with its s.
struct WindowVector {
  LatticePoint<3> point;
  Z s;

  void add_multiple(const Z& k, const WindowVector& other) {
    point.add_multiple(k, other.point);
    s.add_product(k, other.s);
  }
};

/// 4^j |h|^2 + s^2 = 4^j v^2 p.p - (4^j - 1) s^2: this form makes a stretch of about 2^(j+1) rho of the
/// cylinder round.
inline auto window_form(const ExactVelocity<3>& velocity, long j) {
  return [&v2 = velocity.v2, j](const WindowVector& a, const WindowVector& b) {
    const Z along = a.s * b.s;
    return Z(shifted_left(v2 * dot(a.point.p, b.point.p) - along, 2 * j) + along);
  };
}

/// min and max of a and b.
inline std::pair<Z, Z> ordered(const Z& a, const Z& b) {
  return a <= b ? std::pair(a, b) : std::pair(b, a);
}

struct Range {
  Z first, last;  ///< empty if first > last
  bool empty() const { return first > last; }
  Z count() const { return empty() ? Z(0) : Z(last - first + 1); }
};

/// The k with low <= k gap <= high, for gap != 0.
inline Range multiples_between(const Z& low, const Z& high, const Z& gap) {
  return gap > 0 ? Range{ceil_div(low, gap), floor_div(high, gap)}
                 : Range{ceil_div(high, gap), floor_div(low, gap)};
}

/// A vector in coordinates of its lattice plane: y across the flight, z along it.
struct PlanePoint {
  LatticePoint<3> point;
  Z y, z;

  void add_multiple(const Z& k, const PlanePoint& other) {
    point.add_multiple(k, other.point);
    y += k * other.y;
    z += k * other.z;
  }
};

/// The section of the cylinder |h| < rho by one plane, within a window of s.
struct PlaneSection {
  bool empty = true;
  LatticePoint<3> origin;  ///< a centre of the plane
  Z low, high;             ///< the range of the section within the window
  Z half_width;            ///< |y| v of its points is at most this
  Z z_low, z_high;         ///< bounds of their z

  /// (2^i y)^2 + (2^k z)^2, one of i and k 0: the form that makes the section about as wide as it is long.
  auto form() const {
    return [scale = bit_length(z_high - z_low) - bit_length(half_width) - 1](const PlanePoint& a,
                                                                             const PlanePoint& b) {
      const Z across = a.y * b.y, along = a.z * b.z;
      return scale > 0 ? Z(shifted_left(across, 2 * scale) + along)
                       : Z(across + shifted_left(along, -2 * scale));
    };
  }
};

/// The planes spanned by b1 and b2. N = b1 x b2 is normal to them, and e = v x N lies in them, across the
/// flight. In the plane N.c = level, a centre at s that is met has |a s - v^2 level| < rho |e|, a = N.v, and
/// more exactly
///   v^2 (e.c)^2 + (a s - v^2 level)^2 < rho^2 |e|^2.
/// If v is normal to the planes, then e = 0, and s is constant in each of them. In this case y and z are two
/// directions at right angles, e = b1 and v x b1, and the same inequality holds with z for a s - v^2 level.
struct Planes {
  const ExactVelocity<3>& velocity;
  LatticePoint<3> next;  ///< b3, from one plane to the next
  ZVec<3> normal, e, f;
  Z a, gap;
  Z reach2;           ///< rho^2 |v x N|^2
  Z reach;            ///< its root, rounded down: sufficient for integers that are less than the root
  bool head_on;       ///< v is normal to the planes
  Z across2, across;  ///< rho^2 |e|^2 for the e in use, and its root

  Planes(const ExactVelocity<3>& velocity, const Z& rho2, const LatticePoint<3>& b1,
         const LatticePoint<3>& b2, const LatticePoint<3>& b3);

  /// The k3 whose planes offset + k3 b3 come within reach at some s with low <= s <= high.
  Range levels(const LatticePoint<3>& offset, const Z& low, const Z& high) const;

  PlaneSection section(const LatticePoint<3>& offset, const Z& k3, const Z& low, const Z& high) const;

  PlanePoint in_plane(const LatticePoint<3>& b) const;

  /// The k2 for which the row origin + k2 g2 + Z g1 may have a point in the section.
  Range rows(const PlaneSection& section, const PlanePoint& g1, const PlanePoint& g2) const;
};

}  // namespace lorentz::oracle
