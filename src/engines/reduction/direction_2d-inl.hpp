// A 2D Bravais lattice seen along a velocity.
//
// In coordinates (s, h), along the line and across it, the lattice points of the strip |h| < rho are wanted,
// and of these the first with s > 0. Euclid's algorithm on the heights of two basis vectors on either side of
// the line (the continued fraction of the slope) gives a basis R, L with heights D_R >= 0 >= -D_L and D_L < 2
// rho; then every row { n R + m L : m } meets the strip, in one interval of m, and few rows come near the
// start.

/// A lattice vector: integer coefficients in the lattice's short basis.
template <class Numbers>
struct Arm2 {
  using Number = typename Numbers::Number;

  Number n[2];
  Number D, D_low;  ///< |v x vector| as a sum; the first part is kept exact by Euclid's algorithm
  Number S;         ///< v . vector >= 0
  Number D_error, S_error;

  LORENTZ_INLINE void clear() { n[0] = n[1] = D = D_low = S = D_error = S_error = all(0); }

  /// kExact: D is exact, and has no low part.
  template <class Arch, bool kExact>
  LORENTZ_INLINE void subtract(Number k, const Arm2& other) {
    D = Arch::remainder(D, k, other.D);
    if constexpr (!kExact) D_low = D_low - k * other.D_low;
    for (int i = 0; i < 2; ++i) n[i] = n[i] + k * other.n[i];
  }
};

/// Exchanges the members that are set while a basis is reduced. The others are computed from them at the end.
template <class Numbers>
LORENTZ_INLINE void exchange(typename Numbers::Mask m, Arm2<Numbers>& a, Arm2<Numbers>& b) {
  if constexpr (Numbers::kOne) {
    if (m) std::swap(a, b);
  } else {
    for (int i = 0; i < 2; ++i) exchange(m, a.n[i], b.n[i]);
    exchange(m, a.D, b.D), exchange(m, a.D_low, b.D_low);
  }
}

/// What an ellipsoid changes. With w = N v in the notation of shape.hpp, s = along . d, along = N^T w; c
/// stands for the shape's condition. |N| |v| <= c |w|, so w errs by at most 3 c u |w|, rho by (3 c + 5) u
/// rho, and s by 16 c u |N| |w| |d|, all steps of its sum included.
template <class Numbers>
struct WidthOfShape {
  using Number = typename Numbers::Number;

  Number along[2];
  Number along_error;  ///< of s for a vector of size 1
  Number skew;         ///< s v.v = (v . d) v2 + h skew
  Number euclidean_v2;
  double rho_error;    ///< of rho, relative
  double slack_scale;  ///< the slack is (rho^2 - h^2) times this

  /// v2, rho and s_rho as in Direction2.
  LORENTZ_INLINE void set(const Shape& ellipsoid, const Number (&v)[2], Number& v2, Number& rho,
                          Number& s_rho) {
    const Vec* N = ellipsoid.to_ball;
    const Number w[2] = {N[0][0] * v[0] + N[0][1] * v[1], N[1][0] * v[0] + N[1][1] * v[1]};
    for (int k = 0; k < 2; ++k) along[k] = N[0][k] * w[0] + N[1][k] * w[1];
    v2 = square_of(w);
    s_rho = width_of(all(ellipsoid.radius), v2);
    rho = s_rho * all(ellipsoid.inverse_height_scale);
    along_error = ellipsoid.along_error * s_rho;
    rho_error = (kRho + kRhoOfShape * ellipsoid.condition) * kRoundoff;
    slack_scale = ellipsoid.cofactor[2][2] * ellipsoid.cofactor[2][2];
    euclidean_v2 = square_of(v);
    skew = along[1] * v[0] - along[0] * v[1];
  }
};

/// A lattice seen along one direction: all that does not depend on the start.
template <class Numbers, bool kUnit, bool kBall>
struct Direction2 {
  using Number = typename Numbers::Number;
  using Mask = typename Numbers::Mask;
  using Arm = Arm2<Numbers>;
  static constexpr bool kTurned = kUnit && kBall;

  Number v[2];      ///< turned
  Number v2;        ///< in the metric of the shape
  Number rho;       ///< the line meets the obstacle iff |v x d| < rho
  Number passable;  ///< a row whose steps are lower than this enters the strip, whatever rho errs by
  Number s_rho;     ///< r |v|: entries are at s - s_rho at the earliest
  WidthOfShape<Numbers> shape;  ///< not used for balls
  DoubleDouble<Numbers> H[2];   ///< heights v x B_i
  Number H_size[2];             ///< the size of the terms of H_i
  Number S[2];                  ///< s of B_i
  double size_of[2];            ///< at least |B_i|; not used for balls
  Arm R, L;                     ///< h = sigma D_R for R and -sigma D_L for L
  Number sigma;
  Number inverse_A, inverse_D_L, inverse_S_L;  ///< A = |v|^2 times the cell's area
  Mask rises;                                  ///< rows are not parallel to the line
  Mask usable;                                 ///< the rest is good for something

  /// `wanted`: other directions need not be good for anything. Velocities without tiny components.
  template <class Arch>
  LORENTZ_INLINE void set(const Bravais& lattice, const Number (&velocity)[2], Mask wanted) {
    v[0] = velocity[0], v[1] = velocity[1];
    usable = wanted;
    set_width(lattice);
    set_forms<Arch>(lattice);
    set_first_arms<Arch>();
    euclid<Arch>(usable);
    if constexpr (kUnit)
      take_back<Arch>();
    else
      euclid_again<Arch>();
    if constexpr (kUnit && !kBall) go_forward<Arch>();
    finish<Arch>(lattice);
  }

  /// s = along . d.
  LORENTZ_INLINE Number along(int k) const {
    if constexpr (kBall)
      return v[k];
    else
      return shape.along[k];
  }
  LORENTZ_INLINE double rho_error() const {
    if constexpr (kBall)
      return kRho * kRoundoff;
    else
      return shape.rho_error;
  }

 private:
  LORENTZ_INLINE void set_width(const Bravais& lattice) {
    if constexpr (kBall) {
      v2 = square_of(v);
      s_rho = rho = width_of(all(lattice.radius), v2);
    } else {
      shape.set(lattice.shape, v, v2, rho, s_rho);
    }
    passable = 2 * rho * all(1 - kSlop2d);
  }

  template <class Arch>
  LORENTZ_INLINE void set_forms(const Bravais& lattice) {
    using DD = DoubleDouble<Arch>;
    if constexpr (kUnit) {
      H[0] = Neg(v[1]), H[1] = v[0];
      H_size[0] = Abs(v[1]), H_size[1] = Abs(v[0]);
      S[0] = along(0), S[1] = along(1);
      size_of[0] = size_of[1] = 1;
    } else {
      for (int i = 0; i < 2; ++i) {
        const Wide &x = lattice.basis[i][0], &y = lattice.basis[i][1];
        const DD height = add_product(first_product(DD(y), v[0]), DD(x), Neg(v[1]));
        H[i] = DoubleDouble<Numbers>(height.hi, height.lo);
        H_size[i] = Abs(v[0] * all(y.hi)) + Abs(v[1] * all(x.hi)) + all(kBasisInHeight * lattice.basis_error);
        S[i] = along(0) * all(x.hi) + along(1) * all(y.hi);
        size_of[i] = std::fabs(x.hi) + std::fabs(y.hi);
      }
    }
  }

  // Two neighbours of the shortest lattice vectors with the line between them, both pointing forward.
  template <class Arch>
  LORENTZ_INLINE void set_first_arms() {
    const Number one = all(1);
    R.clear(), L.clear();
    sigma = one;
    if constexpr (kTurned) {  // v lies in the first octant
      R.n[1] = L.n[0] = one;
      R.D = v[0], L.D = v[1];
    } else if constexpr (kUnit) {  // the axes that point forward by v, with the line in between
      const Number forward[2] = {CopySign(one, v[0]), CopySign(one, v[1])};
      const Mask steep = Abs(v[0]) < Abs(v[1]);
      R.n[0] = where(steep, forward[0]), R.n[1] = IfThenZeroElse(steep, forward[1]);
      L.n[0] = IfThenZeroElse(steep, forward[0]), L.n[1] = where(steep, forward[1]);
      R.D = select(steep, Abs(v[1]), Abs(v[0])), L.D = select(steep, Abs(v[0]), Abs(v[1]));
      sigma = forward[0] * forward[1] * select(steep, all(-1), one);
    } else {
      set_general_arms<Arch>();
    }
  }

  template <class Arch>
  LORENTZ_INLINE void set_general_arms() {
    const Number zero = all(0), p = CopySign(all(1), S[0]), q = CopySign(all(1), S[1]);
    Number first = p * H[0].hi, second = q * H[1].hi;
    R.n[0] = p, L.n[1] = q;
    R.D_low = p * H[0].lo, L.D_low = q * H[1].lo;
    const Mask outside = first * second > zero;
    if (any(outside)) part_arms<Arch>(outside, p, q, first, second);
    sigma = select(Or(first > zero, second < zero), all(1), all(-1));
    R.D = sigma * first, R.D_low = R.D_low * sigma;
    L.D = Neg(sigma) * second, L.D_low = L.D_low * Neg(sigma);
    usable = And(usable, And(R.D >= zero, L.D >= zero));
    swap_arms(R.D < L.D);
  }

  // The line lies outside their cone: the one farther off goes to the other side, to near - far, which points
  // forward, since the angle between the two is 60 to 90 degrees.
  template <class Arch>
  LORENTZ_INLINE void part_arms(Mask outside, Number p, Number q, Number& first, Number& second) {
    using DD = DoubleDouble<Arch>;
    const Mask first_is_far = Abs(first) > Abs(second), to_R = And(outside, first_is_far),
               to_L = AndNot(first_is_far, outside);
    const DD difference = DD(second, L.D_low) - DD(first, R.D_low),
             height = select(to_L, -difference, difference);
    first = select(to_R, height.hi, first), R.D_low = select(to_R, height.lo, R.D_low);
    second = select(to_L, height.hi, second), L.D_low = select(to_L, height.lo, L.D_low);
    R.n[1] = where(to_R, q), R.n[0] = select(to_R, Neg(p), p);
    L.n[0] = where(to_L, p), L.n[1] = select(to_L, Neg(q), q);
  }

  LORENTZ_INLINE void swap_arms(Mask m) {
    exchange(m, R, L);
    sigma = select(m, Neg(sigma), sigma);
  }

  LORENTZ_INLINE Mask goes_on(const Arm& smaller) const {
    const Mask wide = smaller.D >= passable;
    if constexpr (kUnit)
      return wide;
    else
      return And(wide, Abs(smaller.D_low) <= kMaxLowPart * smaller.D);
  }

  // The quotients are those of the continued fraction; on the unit lattices D_R and D_L are exact throughout.
  // Two steps at a time, so that the arms need not change places at each.
  template <class Arch>
  LORENTZ_INLINE void euclid(Mask going) {
    Arm larger = R, smaller = L;
    Mask flipped = everywhere(false);
    going = And(going, goes_on(smaller));
    while (any(going)) {
      larger.template subtract<Arch, kUnit>(where(going, Floor(larger.D / smaller.D)), smaller);
      const Mask on = goes_on(larger);
      flipped = Or(flipped, AndNot(on, going));
      going = And(going, on);
      if (Numbers::kOne && nowhere(going)) break;
      smaller.template subtract<Arch, kUnit>(where(going, Floor(smaller.D / larger.D)), larger);
      going = And(going, goes_on(smaller));
    }
    R = larger, L = smaller;
    swap_arms(flipped);
  }

  // On the unit lattices: a quotient may have been rounded up to the next integer. Then the height is below
  // zero, and its sum with the other one is exact, because that is the remainder.
  template <class Arch>
  LORENTZ_INLINE void take_back() {
    Mask below = And(usable, L.D < all(0));
    for (int round = 0; round < kMaxRenormalisations && any(below); ++round) {
      L.D = L.D + where(below, R.D);
      for (int i = 0; i < 2; ++i) L.n[i] = L.n[i] - where(below, R.n[i]);
      swap_arms(And(below, R.D < L.D));
      euclid<Arch>(below);
      below = And(below, L.D < all(0));
    }
  }

  template <class Arch>
  LORENTZ_INLINE void euclid_again() {
    Mask again = usable;
    for (int round = 0; round < kMaxRenormalisations; ++round) {
      again = And(renormalise<Arch>(again), usable);
      if (nowhere(again)) return;
      euclid<Arch>(again);
    }
  }

  // Adds the low parts to the high ones; where Euclid's algorithm has to go on from there.
  template <class Arch>
  LORENTZ_INLINE Mask renormalise(Mask m) {
    using DD = DoubleDouble<Arch>;
    const Number zero = all(0);
    for (Arm* arm : {&R, &L}) {
      const DD height = DD::sum(arm->D, arm->D_low);
      arm->D = select(m, height.hi, arm->D), arm->D_low = select(m, height.lo, arm->D_low);
    }
    const Mask below = And(m, L.D < zero);
    if (any(below)) {  // the last quotient was one too large
      const DD height = DD(L.D, L.D_low) + DD(R.D, R.D_low);
      L.D = select(below, height.hi, L.D), L.D_low = select(below, height.lo, L.D_low);
      for (int i = 0; i < 2; ++i) L.n[i] = L.n[i] - where(below, R.n[i]);
    }
    usable = And(usable, And(R.D >= zero, L.D >= zero));
    swap_arms(And(m, R.D < L.D));
    return And(m, L.D >= passable);
  }

  // An arm that points forward by v may point backward in the metric of a shape. If it is L, one more of
  // Euclid's steps: S_R D_L + S_L D_R = A > 0 is the same for every basis, so the vector that replaces it, R'
  // with S_R' D_L = A - S_L D_R', points forward.
  template <class Arch>
  LORENTZ_INLINE void go_forward() {
    const Mask backward = along_arm(L) < all(0);
    if (nowhere(backward)) return;
    const Number k = where(backward, Floor(R.D / L.D));
    usable = And(usable, k < all(kMaxBackwardQuotient));
    R.template subtract<Arch, kUnit>(k, L);
    swap_arms(backward);
  }

  LORENTZ_INLINE Number along_arm(const Arm& arm) const {
    return sum_of_products(arm.n[0], S[0], arm.n[1], S[1]);
  }

  // Usable arms point forward (but R in the metric of a shape), and their coefficients are small: in the
  // first octant they grow with each step, and L's is the later one.
  template <class Arch>
  LORENTZ_INLINE void finish(const Bravais& lattice) {
    for (Arm* arm : {&R, &L}) {
      arm->S = along_arm(*arm);
      if constexpr (!kBall)
        arm->S_error =
            shape.along_error * (Abs(arm->n[0]) * all(size_of[0]) + Abs(arm->n[1]) * all(size_of[1]));
      if constexpr (!kUnit)
        arm->D_error = kAnchorTerms * (Abs(arm->n[0]) * H_size[0] + Abs(arm->n[1]) * H_size[1]);
      if (!(kUnit && !kBall && arm == &R)) usable = And(usable, arm->S >= all(0));
      if (!(kTurned && arm == &R))
        usable =
            And(usable, And(Abs(arm->n[0]) < all(kMaxCoefficient), Abs(arm->n[1]) < all(kMaxCoefficient)));
    }
    if constexpr (!kUnit) {
      const Mask rough = L.D_error * (R.D + rho) > kRoughHeight * L.D * L.D;
      if constexpr (!Arch::kOne)
        usable = AndNot(And(rough, L.D > all(0)), usable);
      else if (rough)
        sum_height_of_L(lattice);
    }
    usable = And(usable, L.D < passable);
    rises = L.D > all(0);
    know_slope<Arch>(lattice);
    inverse_A = 1 / (kUnit ? v2 : v2 * all(lattice.volume));
    inverse_D_L = 1 / L.D;
    inverse_S_L = 1 / L.S;
  }

  // Without rounding.
  LORENTZ_NOINLINE void sum_height_of_L(const Bravais& lattice) {
    Wide height = {-sigma * L.D, -sigma * L.D_low};
    set_height_unrounded(lattice, v, L.n, height, L.D_error);
    L.D = -sigma * height.hi, L.D_low = -sigma * height.lo;
    usable = usable && L.D >= 0;
  }

  // Rows are parallel to the line, exactly, or they certainly rise towards it: by a height of whose error the
  // half does not change its sign, and which does not vanish when it is multiplied by the inverse of an area.
  // (On the unit lattices heights are exact, and none is so small; below zero is one whose last quotient
  // was rounded up again and again.)
  template <class Arch>
  LORENTZ_INLINE void know_slope(const Bravais& lattice) {
    if constexpr (kUnit) {
      usable = And(usable, L.D >= all(0));
    } else {
      const Mask certain = And(L.D > 2 * L.D_error, L.D > all(kSmallestHeight)),
                 level = AndNot(rises, usable);
      usable = And(usable, Or(Not(rises), certain));
      if (nowhere(level)) return;
      L.D_error = where(rises, L.D_error);
      const Number n[2] = {L.n[0], L.n[1]}, w[2] = {v[0], v[1]};
      usable = And(usable, Or(rises, is_parallel<typename Arch::Apart, 2>(lattice, w, n)));
    }
  }
};
