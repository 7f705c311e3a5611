// Coordinates of a 3D lattice as seen along a velocity: two across the line, in units of r, and one along it.

/// The axes in an order in which the smallest component of a vector is the last, c, and a and b follow it in
/// cyclic order. In the first octant the order stays.
template <class Numbers, bool kTurned>
class AxesOf {
  using Number = typename Numbers::Number;
  using Mask = typename Numbers::Mask;

 public:
  LORENTZ_INLINE explicit AxesOf(const Number (&w)[3]) {
    if constexpr (kTurned) return;
    const Mask second = Abs(w[1]) < Abs(w[0]), third = Abs(w[2]) < select(second, Abs(w[1]), Abs(w[0]));
    is_c_[0] = Not(Or(second, third)), is_c_[1] = AndNot(third, second), is_c_[2] = third;
  }
  LORENTZ_INLINE Number a(const Number (&w)[3]) const { return after(w, 1); }
  LORENTZ_INLINE Number b(const Number (&w)[3]) const { return after(w, 2); }
  LORENTZ_INLINE Number c(const Number (&w)[3]) const { return after(w, 0); }
  template <class T>
  LORENTZ_INLINE void put(T (&to)[3], const T& a, const T& b, const T& c) const {
    if constexpr (kTurned)
      to[0] = a, to[1] = b, to[2] = c;
    else  // axis k is c; or a, the one after c; or b
      for (int k = 0; k < 3; ++k) to[k] = select(is_c_[k], c, select(is_c_[(k + 2) % 3], a, b));
  }

 private:
  LORENTZ_INLINE Number after(const Number (&w)[3], int steps) const {
    if constexpr (kTurned) return w[(2 + steps) % 3];
    return select(is_c_[0], w[steps], select(is_c_[1], w[(1 + steps) % 3], w[(2 + steps) % 3]));
  }

  Mask is_c_[3];
};

template <class Numbers, bool kUnit, bool kBall>
struct FrameOf3 {
  using Number = typename Numbers::Number;
  using Pair = DoubleDouble<Numbers>;
  static constexpr bool kTurned = kUnit && kBall;
  /// For unit lattices of balls the third term of the first form, and the low parts of the first and the last
  /// form, are zero. They are left out.
  static constexpr int kFirstTerms = kTurned ? 2 : 3;
  static constexpr bool kLowParts = !kTurned;

  Number v[3];                ///< turned
  Number v2, rho;             ///< in the metric of the shape: |v|^2, r |v|
  Number s_rho;               ///< rho, under its name in 2D
  Number scale[2];            ///< across = scale * (form . n)
  Number across;              ///< for balls: the length of the frame's first vector
  double inverse_r;           ///< a vector of size 1 has an across, and terms of it, of at most this
  double scale_error;         ///< the relative error of |across|^2 from the scale
  double along_size;          ///< a vector of size 1 has an s of at most 4 times this
  Pair along[kBall ? 1 : 3];  ///< s = along . d; not used for balls, whose s is v . d
  Pair cartesian[3][3];       ///< across 0, across 1 and along of the axes
  double size_of[3];          ///< the size of each vector of the short basis

  /// Requires velocities without tiny components.
  template <class Arch>
  LORENTZ_INLINE void set(const Bravais& lattice, const Number (&velocity)[3]) {
    for (int k = 0; k < 3; ++k) v[k] = velocity[k];
    scale_error = kScale * kRoundoff, along_size = 1;
    if constexpr (kBall)
      set_axes<Arch>(lattice);
    else
      set_axes_of_shape<Arch>(lattice);
    s_rho = rho = width_of(all(lattice.radius), v2);
    set_forms<Arch>(lattice);
  }

  /// Across 0, across 1 and along of each vector of the short basis.
  LORENTZ_INLINE const Pair (&form() const)[3][3] {
    if constexpr (kUnit)
      return cartesian;
    else
      return of_basis_;
  }

  /// For balls of another radius: only the scales differ.
  LORENTZ_INLINE void set_radius(const Bravais& lattice) {
    static_assert(kBall);
    s_rho = rho = width_of(all(lattice.radius), v2);
    set_scale(lattice);
  }

  /// Recomputes a vector's across and along from its coefficients. The large terms cancel exactly.
  template <class Arch, class Integer>
  LORENTZ_INLINE void recompute(ArmOf3<Numbers, Integer>& arm, Number length) const {
    using DD = DoubleDouble<Arch>;
    arm.p[0] = scale[0] * compensated_sum<DD, kFirstTerms, kLowParts>(form()[0], arm.n);
    arm.p[1] = scale[1] * compensated_sum<DD>(form()[1], arm.n);
    arm.z = compensated_sum<DD, 3, kLowParts>(form()[2], arm.n) / length;
    Number terms = Abs(high_of(arm.n[0])) * all(size_of[0]);
    for (int j = 1; j < 3; ++j) terms = terms + Abs(high_of(arm.n[j])) * all(size_of[j]);
    arm.cancellation = kAnchorTerms / kRoundoff * kForm * inverse_r * terms;
  }

  /// The two across components and the along component of a Cartesian vector.
  template <class Arch>
  LORENTZ_INLINE void forms_of(const Pair (&d)[3], Pair (&f)[3]) const {
    using DD = DoubleDouble<Arch>;
    for (int i = 0; i < 3; ++i) {
      const Pair(&c)[3] = cartesian[i];
      const DD x = DD::product(d[0].hi, c[0].hi), y = DD::product(d[1].hi, c[1].hi), xy = DD::sum(x.hi, y.hi);
      DD sum = xy;
      Number low = x.lo + y.lo;
      if (!(kTurned && i == 0)) {
        const DD z = DD::product(d[2].hi, c[2].hi);
        sum = DD::sum(xy.hi, z.hi);
        low = low + z.lo;
        if (!(kTurned && i == 2))
          for (int k = 0; k < 3; ++k) low = low + low_part(d[k], c[k]);
      }
      const Number rest = kTurned && i == 0 ? xy.lo + low : (xy.lo + sum.lo) + low;
      const DD all_of_it = DD::sum(sum.hi, rest);
      f[i] = Pair(all_of_it.hi, all_of_it.lo);
    }
  }

 private:
  // Sets two vectors across the line, exactly perpendicular to it and to each other, and v itself.
  template <class Arch>
  LORENTZ_INLINE void set_axes(const Bravais& lattice) {
    using DD = DoubleDouble<Arch>;
    v2 = speed_squared(v[0], v[1], v[2]);
    const AxesOf<Numbers, kTurned> axes(v);
    const Number a = axes.a(v), b = axes.b(v), c = axes.c(v);
    across = sqrt(sum_of_products(a, a, b, b));
    set_scale(lattice);
    const DD ac = -DD::product(a, c), bc = -DD::product(b, c), aabb = DD::product(a, a) + DD::product(b, b);
    axes.put(cartesian[0], Pair(Neg(b)), Pair(a), Pair(all(0)));
    axes.put(cartesian[1], Pair(ac.hi, ac.lo), Pair(bc.hi, bc.lo), Pair(aabb.hi, aabb.lo));
    for (int k = 0; k < 3; ++k) cartesian[2][k] = v[k];
  }

  LORENTZ_INLINE void set_scale(const Bravais& lattice) {
    scale[0] = first_scale(all(1), across, all(lattice.radius));
    scale[1] = scale[0] / sqrt(v2);
    inverse_r = 1 / lattice.radius;
  }

  // The same in the metric of a shape. If the f_i are orthonormal and perpendicular to w = N v, across is
  //   f_i . C (v x d) / (r |w|) = ((C^T f_i) x v) . d / (r |w|).
  // Here f_i and C^T f_i need not be exact: whatever g = C^T f_i is rounded to, g x v is perpendicular to v,
  // so errors do not grow with the distance.
  template <class Arch>
  LORENTZ_INLINE void set_axes_of_shape(const Bravais& lattice) {
    const Shape& shape = lattice.shape;
    set_along<Arch>(shape);
    Number w[3], f[2][3];
    for (int i = 0; i < 3; ++i) {
      const Vec& N = shape.to_ball[i];
      w[i] = sum_of_products(all(N[0]), v[0], all(N[1]), v[1], all(N[2]), v[2]);
    }
    const AxesOf<Numbers, false> axes(w);
    const Number a = axes.a(w), b = axes.b(w), c = axes.c(w), across2 = sum_of_products(a, a, b, b);
    axes.put(f[0], Neg(b), a, all(0));
    axes.put(f[1], Neg(a * c), Neg(b * c), across2);
    across = sqrt(across2);
    const Number speed = sqrt(v2);
    scale[0] = 1 / (across * all(lattice.radius) * speed);
    scale[1] = scale[0] / speed;
    for (int i = 0; i < 2; ++i) set_across<Arch>(shape, f[i], cartesian[i]);
    const double size = std::sqrt(shape.metric_size);
    inverse_r = size * shape.condition / lattice.radius;
    along_size = shape.metric_size > 1 ? shape.metric_size : 1;
    scale_error = kScale * kRoundoff * shape.condition;
  }

  // w = G v, and v2 = w . v.
  template <class Arch>
  LORENTZ_INLINE void set_along(const Shape& shape) {
    using DD = DoubleDouble<Arch>;
    DD image[3];
    apply_metric(shape, v, image);
    DD square = first_product(image[0], v[0]);
    for (int k = 1; k < 3; ++k) square = add_product(square, image[k], v[k]);
    for (int k = 0; k < 3; ++k) cartesian[2][k] = along[k] = Pair(image[k].hi, image[k].lo);
    v2 = square.hi;
  }

  // g x v, with g = C^T f.
  template <class Arch>
  LORENTZ_INLINE void set_across(const Shape& shape, const Number (&f)[3], Pair (&axis)[3]) const {
    using DD = DoubleDouble<Arch>;
    Number g[3];
    for (int k = 0; k < 3; ++k) {
      const Vec(&C)[3] = shape.cofactor;
      g[k] = sum_of_products(all(C[0][k]), f[0], all(C[1][k]), f[1], all(C[2][k]), f[2]);
    }
    for (int k = 0; k < 3; ++k) {
      const int j = (k + 1) % 3, l = (k + 2) % 3;
      const DD component = DD::product(g[j], v[l]) - DD::product(g[l], v[j]);
      axis[k] = Pair(component.hi, component.lo);
    }
  }

  static LORENTZ_INLINE Number low_part(const Pair& d, const Pair& c) {
    if constexpr (kUnit)  // where starts have no low parts
      return d.hi * c.lo;
    else
      return d.hi * c.lo + d.lo * c.hi;
  }

  // Sets across and along of each vector of the short basis.
  template <class Arch>
  LORENTZ_INLINE void set_forms(const Bravais& lattice) {
    for (int i = 0; i < 3; ++i) {
      if constexpr (kUnit) {
        size_of[i] = 1;
      } else {
        const WideVec& B = lattice.basis[i];
        const Pair b[3] = {Pair(B[0]), Pair(B[1]), Pair(B[2])};
        Pair f[3];
        forms_of<Arch>(b, f);
        for (int k = 0; k < 3; ++k) of_basis_[k][i] = f[k];
        size_of[i] =
            std::fabs(B[0].hi) + std::fabs(B[1].hi) + std::fabs(B[2].hi) + kBasisInSize * lattice.basis_error;
      }
    }
  }

  Pair of_basis_[3][3];  // not on the unit lattices, whose basis is the axes
};
