// The first ball of a 2D Bravais lattice that a line meets, in O(log 1/r). Private to the reduction engine.
//
// In coordinates (s, h), along the line and across it, the lattice points of the strip |h| < rho are wanted,
// and of these the first with s > 0. Euclid's algorithm on the heights of two basis vectors on either side of
// the line (the continued fraction of the slope) gives a basis R, L with heights D_R >= 0 >= -D_L and D_L < 2
// rho; then every row { n R + m L : m } meets the strip, in one interval of m, and few rows come near the
// start.
#pragma once

#include <algorithm>

#include "src/engines/reduction/formulas.hpp"
#include "src/engines/reduction/offset.hpp"

namespace lorentz {

/// A lattice vector: integer coefficients in the lattice's short basis.
struct Arm2 {
  double n[2]{};
  double D = 0, D_low = 0;  ///< |v x vector| as a sum; the first part is kept exact by Euclid's algorithm
  double S = 0;             ///< v . vector >= 0

  double D_error = 0, S_error = 0;

  /// kExact: D is exact, and has no low part.
  template <class Arch, bool kExact>
  void subtract(double k, const Arm2& other) {
    D = Arch::remainder(D, k, other.D);
    if constexpr (!kExact) D_low -= k * other.D_low;
    n[0] += k * other.n[0];
    n[1] += k * other.n[1];
  }
};

/// What an ellipsoid changes. With w = N v in the notation of shape.hpp, s = along . d, along = N^T w; c
/// stands for the shape's condition. |N| |v| <= c |w|, so w errs by at most 3 c u |w|, rho by (3 c + 5) u
/// rho, and s by 16 c u |N| |w| |d|, all steps of its sum included.
struct WidthOfShape {
  double along[2];
  double along_error;  ///< of s for a vector of size 1
  double rho_error;    ///< of rho, relative
  double slack_scale;  ///< the slack is (rho^2 - h^2) times this
  double skew;         ///< s v.v = (v . d) v2 + h skew
  double euclidean_v2;
  double v2, rho, s_rho;  ///< as in Direction2

  void set(const Shape& ellipsoid, const Vec& v) {
    const Vec* N = ellipsoid.to_ball;
    const double w[2] = {sum_of_products(N[0][0], v[0], N[0][1], v[1]),
                         sum_of_products(N[1][0], v[0], N[1][1], v[1])};
    for (int k = 0; k < 2; ++k) along[k] = sum_of_products(N[0][k], w[0], N[1][k], w[1]);
    v2 = square_of(w);
    s_rho = width_of(ellipsoid.radius, v2);
    rho = s_rho * ellipsoid.inverse_height_scale;
    along_error = ellipsoid.along_error * s_rho;
    rho_error = (kRho + kRhoOfShape * ellipsoid.condition) * kRoundoff;
    slack_scale = ellipsoid.cofactor[2][2] * ellipsoid.cofactor[2][2];
    euclidean_v2 = speed_squared(v[0], v[1], 0.0);
    skew = along[1] * v[0] - along[0] * v[1];
  }
};

/// A lattice seen along one direction: all that does not depend on the start.
template <bool kUnit, bool kBall>
struct Direction2 {
  static constexpr bool kTurned = kUnit && kBall;

  Vec v;                    ///< turned, components below kTinyComponent taken as zero
  double v2 = 0;            ///< in the metric of the shape
  double rho = 0;           ///< the line meets the obstacle iff |v x d| < rho
  double passable = 0;      ///< a row whose steps are lower than this enters the strip, whatever rho errs by
  double s_rho = 0;         ///< r |v|: entries are at s - s_rho at the earliest
  WidthOfShape shape;       ///< not used for balls
  Wide H[2];                ///< heights v x B_i
  double M[2]{};            ///< the size of the terms of H_i
  double S[2]{};            ///< s of B_i
  double size_of[2]{1, 1};  ///< at least |B_i|; not used for balls
  Arm2 R, L;                ///< h = sigma D_R for R and -sigma D_L for L
  double sigma = 1;
  double inverse_A = 0, inverse_D_L = 0, inverse_S_L = 0;  ///< A = |v|^2 times the cell's area
  bool usable = true;

  template <class Arch>
  Direction2(Arch, const Bravais& lattice, const Octant& octant, const Vec& velocity) {
    octant.turn<kTurned>(velocity, v);
    set_width(lattice);
    set_forms<Arch>(lattice);
    set_first_arms();
    euclid<Arch>();
    if constexpr (!kUnit)
      for (int round = 0; round < kMaxRenormalisations && usable && renormalise(); ++round) euclid<Arch>();
    if constexpr (kUnit && !kBall) go_forward<Arch>();
    finish(lattice);
  }

 private:
  void set_width(const Bravais& lattice) {
    if constexpr (kBall) {
      v2 = speed_squared(v[0], v[1], 0.0);
      s_rho = rho = width_of(lattice.radius, v2);
    } else {
      shape.set(lattice.shape, v);
      v2 = shape.v2, rho = shape.rho, s_rho = shape.s_rho;
    }
    passable = 2 * rho * (1 - kSlop2d);
  }

  double along_of(int k) const {
    if constexpr (kBall) return v[k];
    return shape.along[k];
  }

  template <class Arch>
  void set_forms(const Bravais& lattice) {
    using DD = DoubleDouble<Arch>;
    if constexpr (kUnit) {
      H[0] = Wide(-v[1]), H[1] = Wide(v[0]);
      M[0] = std::fabs(v[1]), M[1] = std::fabs(v[0]);
      S[0] = along_of(0), S[1] = along_of(1);
    } else {
      for (int i = 0; i < 2; ++i) {
        const DD x(lattice.basis[i][0]), y(lattice.basis[i][1]);
        H[i] = Wide(add_product(first_product(y, v[0]), x, -v[1]));
        M[i] = std::fabs(v[0] * y.hi) + std::fabs(v[1] * x.hi) + kBasisInHeight * lattice.basis_error;
        S[i] = sum_of_products(along_of(0), x.hi, along_of(1), y.hi);
        if constexpr (!kBall) size_of[i] = std::fabs(x.hi) + std::fabs(y.hi);
      }
    }
  }

  // Two neighbours of the shortest lattice vectors with the line between them, both pointing forward.
  void set_first_arms() {
    if constexpr (kTurned) {  // v lies in the first octant
      R.n[1] = L.n[0] = 1;
      R.D = v[0], L.D = v[1];
      return;
    }
    if constexpr (kUnit) {  // the axes that point forward by v, with the line in between
      const double forward[2] = {std::copysign(1, v[0]), std::copysign(1, v[1])};
      const int k = std::fabs(v[0]) < std::fabs(v[1]);
      R.n[1 - k] = forward[1 - k], L.n[k] = forward[k];
      R.D = std::fabs(v[k]), L.D = std::fabs(v[1 - k]);
      sigma = forward[0] * forward[1] * (1 - 2 * k);
      return;
    }
    const double p = std::copysign(1, S[0]), q = std::copysign(1, S[1]);
    double first = p * H[0].hi, second = q * H[1].hi;
    R.n[0] = p, L.n[1] = q;
    R.D_low = p * H[0].lo, L.D_low = q * H[1].lo;
    if (first * second > 0) {  // the line lies outside their cone: the one farther off goes to the other side
      Arm2& far = std::fabs(first) > std::fabs(second) ? R : L;
      const Arm2& near = std::fabs(first) > std::fabs(second) ? L : R;
      double& far_height = std::fabs(first) > std::fabs(second) ? first : second;
      const double near_height = std::fabs(first) > std::fabs(second) ? second : first;
      // near - far: forward, since the angle between the two is 60 to 90 degrees.
      const Wide height = Wide(near_height, near.D_low) - Wide(far_height, far.D_low);
      far_height = height.hi, far.D_low = height.lo;
      far.n[0] = near.n[0] - far.n[0], far.n[1] = near.n[1] - far.n[1];
    }
    sigma = first > 0 || second < 0 ? 1 : -1;
    R.D = sigma * first, R.D_low *= sigma;
    L.D = -sigma * second, L.D_low *= -sigma;
    usable = R.D >= 0 && L.D >= 0;
    if (R.D < L.D) swap_arms();
  }

  void swap_arms() {
    std::swap(R, L);
    sigma = -sigma;
  }

  // The quotients are those of the continued fraction; on the unit lattices D_R and D_L are exact throughout.
  // Two steps at a time, so that the arms need not change places at each.
  template <class Arch>
  void euclid() {
    Arm2 larger = R, smaller = L;
    while (goes_on(smaller)) {
      larger.template subtract<Arch, kUnit>(std::floor(larger.D / smaller.D), smaller);
      if (!goes_on(larger)) {
        R = smaller, L = larger, sigma = -sigma;
        return;
      }
      smaller.template subtract<Arch, kUnit>(std::floor(smaller.D / larger.D), larger);
    }
    R = larger, L = smaller;
  }

  // An arm that points forward by v may point backward in the metric of a shape. If it is L, one more of
  // Euclid's steps: S_R D_L + S_L D_R = A > 0 is the same for every basis, so the vector that replaces it, R'
  // with S_R' D_L = A - S_L D_R', points forward.
  template <class Arch>
  void go_forward() {
    if (!(along_arm(L) < 0)) return;
    const double k = std::floor(R.D / L.D);
    usable = k < kMaxBackwardQuotient;
    R.subtract<Arch, kUnit>(k, L);
    swap_arms();
  }

  double along_arm(const Arm2& arm) const { return sum_of_products(arm.n[0], S[0], arm.n[1], S[1]); }

  bool goes_on(const Arm2& smaller) const {
    return smaller.D >= passable && (kUnit || std::fabs(smaller.D_low) <= kMaxLowPart * smaller.D);
  }

  // Adds the low parts to the high ones; true if Euclid's algorithm has to go on from there.
  bool renormalise() {
    for (Arm2* arm : {&R, &L}) {
      const Wide height = Wide::sum(arm->D, arm->D_low);
      arm->D = height.hi, arm->D_low = height.lo;
    }
    if (L.D < 0) {  // the last quotient was one too large
      const Wide height = Wide(L.D, L.D_low) + Wide(R.D, R.D_low);
      L.D = height.hi, L.D_low = height.lo;
      L.n[0] -= R.n[0], L.n[1] -= R.n[1];
    }
    usable = R.D >= 0 && L.D >= 0;
    if (R.D < L.D) swap_arms();
    return L.D >= passable;
  }

  void finish(const Bravais& lattice) {
    for (Arm2* arm : {&R, &L}) {
      arm->S = along_arm(*arm);
      if constexpr (!kBall)
        arm->S_error =
            shape.along_error * (std::fabs(arm->n[0]) * size_of[0] + std::fabs(arm->n[1]) * size_of[1]);
      if (!kUnit) arm->D_error = kAnchorTerms * (std::fabs(arm->n[0]) * M[0] + std::fabs(arm->n[1]) * M[1]);
    }
    usable = usable && L.D < passable && is_usable(R) && is_usable(L) && knows_slope(lattice);
    inverse_A = 1 / (kUnit ? v2 : v2 * lattice.volume);
    inverse_D_L = 1 / L.D;
    inverse_S_L = 1 / L.S;
  }

  // It points forward, and its coefficients are small: in the first octant they grow with each step, and L's
  // is the later one.
  bool is_usable(const Arm2& arm) const {
    const bool forward = arm.S >= 0 || (kUnit && !kBall && &arm == &R);
    return forward && ((kTurned && &arm == &R) ||
                       (std::fabs(arm.n[0]) < kMaxCoefficient && std::fabs(arm.n[1]) < kMaxCoefficient));
  }

  // Rows are parallel to the line, exactly, or they certainly rise towards it: by a height of whose error the
  // half does not change its sign, and which does not vanish when it is multiplied by the inverse of an area.
  // (On the unit lattices heights are exact, and none is so small; below zero is one whose last quotient was
  // rounded up.)
  bool knows_slope(const Bravais& lattice) {
    if constexpr (kUnit) return L.D >= 0;
    if (L.D > 0) return L.D > 2 * L.D_error && L.D > kSmallestHeight;
    L.D_error = 0;
    return is_parallel(lattice, v, L.n);
  }
};

}  // namespace lorentz
