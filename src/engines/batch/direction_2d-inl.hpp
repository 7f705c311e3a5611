// A 2D lattice seen along the velocities, in lanes: src/engines/reduction/direction_2d.hpp. Private to the
// batch engine.
#if defined(LORENTZ_BATCH_DIRECTION_2D_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LORENTZ_BATCH_DIRECTION_2D_INL_HPP
#undef LORENTZ_BATCH_DIRECTION_2D_INL_HPP
#else
#define LORENTZ_BATCH_DIRECTION_2D_INL_HPP
#endif

#include "src/engines/batch/time-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lorentz {
namespace HWY_NAMESPACE {
namespace {

/// A lattice vector: Arm2.
struct Arm2 {
  V n[2];
  V D, D_low, S, D_error, S_error;

  /// In the lanes in which k is not zero.
  template <bool kUnit>
  HWY_INLINE void subtract(V k, const Arm2& other) {
    D = NegMulAdd(k, other.D, D);
    if constexpr (!kUnit) D_low = D_low - k * other.D_low;
    for (int i = 0; i < 2; ++i) n[i] = n[i] + k * other.n[i];
  }
};

HWY_INLINE void exchange(M m, Arm2& a, Arm2& b) {
  for (int i = 0; i < 2; ++i) exchange(m, a.n[i], b.n[i]);
  exchange(m, a.D, b.D), exchange(m, a.D_low, b.D_low);
}

/// The lattice along each lane's velocity: all that does not depend on the start.
template <bool kUnit, bool kBall>
struct Direction2 {
  static constexpr bool kTurned = kUnit && kBall;

  V v[2];  ///< turned
  V v2, rho, passable, s_rho;
  V along[2];                         ///< s = along . d: of balls, v itself
  V along_error, euclidean_v2, skew;  ///< not used for balls
  double rho_error, slack_scale;
  Pair H[2];
  V M_[2], S[2];
  double size_of[2];
  Arm2 R, L;
  V sigma, inverse_A, inverse_D_L, inverse_S_L;
  M rises;  ///< rows are not parallel to the line

  HWY_INLINE void set(const Bravais& lattice, const V (&velocity)[2], Lanes& lanes) {
    v[0] = velocity[0], v[1] = velocity[1];
    set_width(lattice);
    set_forms(lattice);
    set_first_arms(lanes);
    euclid(lanes.active);
    if constexpr (!kUnit) euclid_again(lanes);
    if constexpr (kUnit && !kBall) go_forward(lanes);
    finish(lattice, lanes);
  }

 private:
  HWY_INLINE void set_width(const Bravais& lattice) {
    const V speed2 = v[0] * v[0] + v[1] * v[1];
    if constexpr (kBall) {
      v2 = speed2;
      s_rho = rho = all(lattice.radius) * Sqrt(v2);
      along[0] = v[0], along[1] = v[1];
      rho_error = kRho * kRoundoff, slack_scale = 1;
    } else {
      const Shape& shape = lattice.shape;
      const Vec* N = shape.to_ball;
      const V w[2] = {all(N[0][0]) * v[0] + all(N[0][1]) * v[1], all(N[1][0]) * v[0] + all(N[1][1]) * v[1]};
      for (int k = 0; k < 2; ++k) along[k] = all(N[0][k]) * w[0] + all(N[1][k]) * w[1];
      v2 = w[0] * w[0] + w[1] * w[1];
      s_rho = all(shape.radius) * Sqrt(v2);
      rho = s_rho * all(shape.inverse_height_scale);
      along_error = all(shape.along_error) * s_rho;
      rho_error = (kRho + kRhoOfShape * shape.condition) * kRoundoff;
      slack_scale = shape.cofactor[2][2] * shape.cofactor[2][2];
      euclidean_v2 = speed2;
      skew = along[1] * v[0] - along[0] * v[1];
    }
    passable = all(2) * rho * all(1 - kSlop2d);
  }

  HWY_INLINE void set_forms(const Bravais& lattice) {
    if constexpr (kUnit) {
      H[0] = Pair(Neg(v[1])), H[1] = Pair(v[0]);
      M_[0] = Abs(v[1]), M_[1] = Abs(v[0]);
      S[0] = along[0], S[1] = along[1];
      size_of[0] = size_of[1] = 1;
      return;
    }
    for (int i = 0; i < 2; ++i) {
      const Wide &x = lattice.basis[i][0], &y = lattice.basis[i][1];
      H[i] = add_product(first_product(Pair(y), v[0]), Pair(x), Neg(v[1]));
      M_[i] = Abs(v[0] * all(y.hi)) + Abs(v[1] * all(x.hi)) + all(kBasisInHeight * lattice.basis_error);
      S[i] = along[0] * all(x.hi) + along[1] * all(y.hi);
      size_of[i] = std::fabs(x.hi) + std::fabs(y.hi);
    }
  }

  HWY_INLINE void set_first_arms(Lanes& lanes) {
    const V zero = none(), one = all(1);
    R = L = Arm2{{zero, zero}, zero, zero, zero, zero, zero};
    sigma = one;
    if constexpr (kTurned) {
      R.n[1] = L.n[0] = one;
      R.D = v[0], L.D = v[1];
      return;
    }
    if constexpr (kUnit) {  // the axes that point forward by v, with the line in between
      const V forward[2] = {CopySign(one, v[0]), CopySign(one, v[1])};
      const M steep = Abs(v[0]) < Abs(v[1]);
      R.n[0] = where(steep, forward[0]), R.n[1] = IfThenZeroElse(steep, forward[1]);
      L.n[0] = IfThenZeroElse(steep, forward[0]), L.n[1] = where(steep, forward[1]);
      R.D = select(steep, Abs(v[1]), Abs(v[0])), L.D = select(steep, Abs(v[0]), Abs(v[1]));
      sigma = forward[0] * forward[1] * select(steep, all(-1), one);
      return;
    }
    const V p = CopySign(one, S[0]), q = CopySign(one, S[1]);
    V first = p * H[0].hi, second = q * H[1].hi;
    R.n[0] = p, L.n[1] = q;
    R.D_low = p * H[0].lo, L.D_low = q * H[1].lo;
    const M outside = first * second > zero, first_is_far = Abs(first) > Abs(second);
    const Pair difference = Pair{second, L.D_low} - Pair{first, R.D_low};
    const M to_R = And(outside, first_is_far), to_L = AndNot(first_is_far, outside);
    const Pair height = select(to_L, -difference, difference);
    first = select(to_R, height.hi, first), R.D_low = select(to_R, height.lo, R.D_low);
    second = select(to_L, height.hi, second), L.D_low = select(to_L, height.lo, L.D_low);
    // near - far; of the four coefficients two are zero.
    R.n[1] = where(to_R, q), R.n[0] = select(to_R, Neg(p), p);
    L.n[0] = where(to_L, p), L.n[1] = select(to_L, Neg(q), q);
    sigma = select(Or(first > zero, second < zero), one, all(-1));
    R.D = sigma * first, R.D_low = R.D_low * sigma;
    L.D = Neg(sigma) * second, L.D_low = L.D_low * Neg(sigma);
    lanes.leave_unless(And(R.D >= zero, L.D >= zero));
    swap_arms(R.D < L.D);
  }

  HWY_INLINE void swap_arms(M m) {
    exchange(m, R, L);
    sigma = select(m, Neg(sigma), sigma);
  }

  HWY_INLINE M goes_on(const Arm2& smaller) const {
    const M wide = smaller.D >= passable;
    if constexpr (kUnit) return wide;
    return And(wide, Abs(smaller.D_low) <= all(kMaxLowPart) * smaller.D);
  }

  // Two steps at a time, so that the arms need not change places at each.
  HWY_INLINE void euclid(M going) {
    Arm2 larger = R, smaller = L;
    M flipped = no_lane();
    going = And(going, goes_on(smaller));
    while (any(going)) {
      larger.subtract<kUnit>(where(going, Floor(larger.D / smaller.D)), smaller);
      const M on = goes_on(larger);
      flipped = Or(flipped, AndNot(on, going));
      going = And(going, on);
      smaller.subtract<kUnit>(where(going, Floor(smaller.D / larger.D)), larger);
      going = And(going, goes_on(smaller));
    }
    R = larger, L = smaller;
    swap_arms(flipped);
  }

  HWY_INLINE void euclid_again(Lanes& lanes) {
    M again = lanes.active;
    for (int round = 0; round < kMaxRenormalisations; ++round) {
      again = And(renormalise(again, lanes), lanes.active);
      if (nowhere(again)) return;
      euclid(again);
    }
  }

  // Lanes in which Euclid's algorithm has to go on.
  HWY_INLINE M renormalise(M m, Lanes& lanes) {
    const V zero = none();
    for (Arm2* arm : {&R, &L}) {
      const Pair height = Pair::sum(arm->D, arm->D_low);
      arm->D = select(m, height.hi, arm->D), arm->D_low = select(m, height.lo, arm->D_low);
    }
    const M below = And(m, L.D < zero);
    if (any(below)) {  // the last quotient was one too large
      const Pair height = Pair{L.D, L.D_low} + Pair{R.D, R.D_low};
      L.D = select(below, height.hi, L.D), L.D_low = select(below, height.lo, L.D_low);
      for (int i = 0; i < 2; ++i) L.n[i] = L.n[i] - where(below, R.n[i]);
    }
    lanes.leave_unless(And(R.D >= zero, L.D >= zero));
    swap_arms(And(m, R.D < L.D));
    return And(m, L.D >= passable);
  }

  HWY_INLINE V along_arm(const Arm2& arm) const { return arm.n[0] * S[0] + arm.n[1] * S[1]; }

  // One more of Euclid's steps where L points backward in the metric of the shape.
  HWY_INLINE void go_forward(Lanes& lanes) {
    const M backward = along_arm(L) < none();
    if (nowhere(backward)) return;
    const V k = where(backward, Floor(R.D / L.D));
    lanes.leave_unless(k < all(kMaxBackwardQuotient));
    R.template subtract<kUnit>(k, L);
    swap_arms(backward);
  }

  HWY_INLINE void finish(const Bravais& lattice, Lanes& lanes) {
    const V zero = none(), big = all(kMaxCoefficient);
    for (Arm2* arm : {&R, &L}) {
      arm->S = along_arm(*arm);
      if constexpr (!kBall)
        arm->S_error = along_error * (Abs(arm->n[0]) * all(size_of[0]) + Abs(arm->n[1]) * all(size_of[1]));
      if constexpr (!kUnit)
        arm->D_error = all(kAnchorTerms) * (Abs(arm->n[0]) * M_[0] + Abs(arm->n[1]) * M_[1]);
      if (!(kUnit && !kBall && arm == &R)) lanes.leave_unless(arm->S >= zero);
      lanes.leave_unless(Max(Abs(arm->n[0]), Abs(arm->n[1])) < big);
    }
    lanes.leave_unless(L.D < passable);
    rises = L.D > zero;
    if constexpr (kUnit)
      lanes.leave_unless(L.D >= zero);
    else
      know_slope(lattice, lanes);
    lanes.leave_unless(L.S > zero);  // one at a time divides by it too, and knows what to do with an infinity
    inverse_A = all(1) / (kUnit ? v2 : v2 * all(lattice.volume));
    inverse_D_L = all(1) / L.D;
    inverse_S_L = all(1) / L.S;
  }

  HWY_INLINE void know_slope(const Bravais& lattice, Lanes& lanes) {
    lanes.leave(And(rises, Not(And(L.D > all(2) * L.D_error, L.D > all(kSmallestHeight)))));
    const M level = AndNot(rises, lanes.active);
    if (nowhere(level)) return;
    L.D_error = where(rises, L.D_error);
    lanes.leave(AndNot(is_parallel(lattice, L.n[0], L.n[1], v[0], v[1]), level));
  }

  // Lanes in which the lattice vector n is exactly parallel to v; not where lanes cannot tell.
  static HWY_NOINLINE M is_parallel(const Bravais& lattice, V n0, V n1, V v0, V v1) {
    if (!lattice.exact) return no_lane();
    V w[2];
    M exact = Not(no_lane());
    const V zero = none();
    for (int k = 0; k < 2; ++k) {
      const Pair a = Pair::product(n0, all(lattice.basis[0][k].hi)),
                 b = Pair::product(n1, all(lattice.basis[1][k].hi)), sum = Pair::sum(a.hi, b.hi);
      exact = And(exact, And(And(a.lo == zero, b.lo == zero), sum.lo == zero));
      w[k] = sum.hi;
    }
    const Pair a = Pair::product(v0, w[1]), b = Pair::product(v1, w[0]);
    return And(exact, And(a.hi == b.hi, a.lo == b.lo));
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace lorentz
HWY_AFTER_NAMESPACE();

#endif
