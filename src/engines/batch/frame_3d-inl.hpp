// Coordinates of a 3D lattice as seen along the velocities, in lanes: src/engines/reduction/frame_3d.hpp.
// Private to the batch engine.
#if defined(LORENTZ_BATCH_FRAME_3D_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LORENTZ_BATCH_FRAME_3D_INL_HPP
#undef LORENTZ_BATCH_FRAME_3D_INL_HPP
#else
#define LORENTZ_BATCH_FRAME_3D_INL_HPP
#endif

#include "src/engines/batch/time-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lorentz {
namespace HWY_NAMESPACE {
namespace {

/// A lattice vector: Arm3.
struct Arm3 {
  V n[3], p[2], z, cancellation;

  HWY_INLINE void subtract(V k, const Arm3& other) {
    for (int i = 0; i < 3; ++i) n[i] = n[i] - k * other.n[i];
    p[0] = p[0] - k * other.p[0], p[1] = p[1] - k * other.p[1];
    z = z - k * other.z;
  }
  HWY_INLINE V largest_coefficient() const { return largest(Abs(n[0]), Abs(n[1]), Abs(n[2])); }
};

HWY_INLINE V product(const Arm3& a, const Arm3& b) {
  return a.p[0] * b.p[0] + a.p[1] * b.p[1] + a.z * b.z;
}

/// But for what is computed anew after any exchange.
HWY_INLINE void exchange(M m, Arm3& a, Arm3& b) {
  for (int i = 0; i < 3; ++i) exchange(m, a.n[i], b.n[i]);
  exchange(m, a.p[0], b.p[0]), exchange(m, a.p[1], b.p[1]), exchange(m, a.z, b.z);
}

/// Across (twice) and along: the forms of the lattice vectors, and their scales.
template <bool kUnit, bool kBall>
struct Frame3 {
  static constexpr bool kTurned = kUnit && kBall;

  V v[3];  ///< turned
  V v2, rho, s_rho, across, scale[2];
  double inverse_r, scale_error, along_size;
  Pair along[kBall ? 1 : 3];  ///< s = along . d; of balls, v itself
  Pair cartesian[3][3], form[3][3];
  double size_of[3];

  HWY_INLINE void set(const Bravais& lattice, const V (&velocity)[3]) {
    for (int k = 0; k < 3; ++k) v[k] = velocity[k];
    scale_error = kScale * kRoundoff, along_size = 1;
    if constexpr (kBall)
      set_axes(lattice);
    else
      set_axes_of_shape(lattice);
    s_rho = rho = all(lattice.radius) * Sqrt(v2);
    set_forms(lattice);
  }

  /// For balls of another radius: only the scales differ.
  HWY_INLINE void set_radius(const Bravais& lattice) {
    s_rho = rho = all(lattice.radius) * Sqrt(v2);
    set_scale(lattice);
  }

  /// A vector's across and along from its coefficients. (On the unit lattices of balls the third coefficient
  /// of the first form, and the low parts of the first and the third, are zero: they are left out.)
  HWY_INLINE void recompute(Arm3& arm, V length) const {
    for (int i = 0; i < 2; ++i) arm.p[i] = scale[i] * form_of(i, arm.n);
    arm.z = form_of(2, arm.n) / length;
    V terms = Abs(arm.n[0]) * all(size_of[0]);
    for (int j = 1; j < 3; ++j) terms = terms + Abs(arm.n[j]) * all(size_of[j]);
    arm.cancellation = all(kAnchorTerms / kRoundoff * kForm * inverse_r) * terms;
  }

  /// Form i of coefficients.
  HWY_INLINE V form_of(int i, const V (&n)[3]) const {
    const Pair(&f)[3] = form[i];
    const Pair a = Pair::product(n[0], f[0].hi), b = Pair::product(n[1], f[1].hi), ab = Pair::sum(a.hi, b.hi);
    if (kTurned && i == 0) return ab.hi + (ab.lo + (a.lo + b.lo));
    const Pair c = Pair::product(n[2], f[2].hi), sum = Pair::sum(ab.hi, c.hi);
    V low;
    if (kTurned && i == 2)
      low = a.lo + b.lo + c.lo;
    else
      low = (a.lo + n[0] * f[0].lo) + (b.lo + n[1] * f[1].lo) + (c.lo + n[2] * f[2].lo);
    return sum.hi + ((ab.lo + sum.lo) + low);
  }

  /// The same from a start.
  HWY_INLINE V form_of(int i, const V (&n)[3], Pair start) const {
    const Pair(&f)[3] = form[i];
    const Pair a = Pair::product(n[0], f[0].hi), b = Pair::product(n[1], f[1].hi), ab = Pair::sum(a.hi, b.hi);
    if (kTurned && i == 0) {
      const Pair sum = Pair::sum(ab.hi, start.hi);
      return sum.hi + ((ab.lo + (sum.lo + start.lo)) + (a.lo + b.lo));
    }
    const Pair c = Pair::product(n[2], f[2].hi), abc = Pair::sum(ab.hi, c.hi),
               sum = Pair::sum(abc.hi, start.hi);
    V low = c.lo;
    if (!(kTurned && i == 2)) low = c.lo + (n[0] * f[0].lo + n[1] * f[1].lo + n[2] * f[2].lo);
    return sum.hi + (((ab.lo + abc.lo) + (sum.lo + start.lo)) + ((a.lo + b.lo) + low));
  }

  /// Across (twice) and along of a Cartesian vector.
  HWY_INLINE void forms_of(const Pair (&d)[3], Pair (&f)[3]) const {
    for (int i = 0; i < 3; ++i) {
      const Pair(&c)[3] = cartesian[i];
      const Pair x = Pair::product(d[0].hi, c[0].hi), y = Pair::product(d[1].hi, c[1].hi),
                 xy = Pair::sum(x.hi, y.hi);
      if (kTurned && i == 0) {
        f[i] = Pair::sum(xy.hi, xy.lo + (x.lo + y.lo));
        continue;
      }
      const Pair z = Pair::product(d[2].hi, c[2].hi), sum = Pair::sum(xy.hi, z.hi);
      V low = (x.lo + y.lo) + z.lo;
      if (!(kTurned && i == 2))
        for (int k = 0; k < 3; ++k) {
          V term = d[k].hi * c[k].lo;
          if constexpr (!kUnit) term = term + d[k].lo * c[k].hi;
          low = low + term;
        }
      f[i] = Pair::sum(sum.hi, (xy.lo + sum.lo) + low);
    }
  }

 private:
  // Two vectors across the line, exactly perpendicular to it and to each other, and v itself.
  HWY_INLINE void set_axes(const Bravais& lattice) {
    v2 = (v[0] * v[0] + v[1] * v[1]) + v[2] * v[2];
    M is[3];
    V a = v[0], b = v[1], c = v[2];
    if constexpr (!kTurned) choose_axes(v, is, a, b, c);
    across = Sqrt(a * a + b * b);
    set_scale(lattice);
    const Pair zero = Pair(none()), ac = -Pair::product(a, c), bc = -Pair::product(b, c),
               aabb = Pair::product(a, a) + Pair::product(b, b);
    for (int k = 0; k < 3; ++k) {
      if constexpr (kTurned) {  // c is the last axis
        cartesian[0][k] = k == 0 ? Pair(Neg(b)) : k == 1 ? Pair(a) : zero;
        cartesian[1][k] = k == 0 ? ac : k == 1 ? bc : aabb;
      } else {  // axis k is c; or a, the one after c; or b
        const M is_a = is[(k + 2) % 3];
        cartesian[0][k] = Pair(IfThenZeroElse(is[k], select(is_a, Neg(b), a)));
        cartesian[1][k] = select(is[k], aabb, select(is_a, ac, bc));
      }
      cartesian[2][k] = Pair(v[k]);
    }
  }

  // c is the smallest component, is[k] says which; a and b are the ones after it.
  static HWY_INLINE void choose_axes(const V (&w)[3], M (&is)[3], V& a, V& b, V& c) {
    const M second = Abs(w[1]) < Abs(w[0]), third = Abs(w[2]) < select(second, Abs(w[1]), Abs(w[0]));
    is[0] = Not(Or(second, third)), is[1] = AndNot(third, second), is[2] = third;
    c = select(is[0], w[0], select(is[1], w[1], w[2]));
    a = select(is[0], w[1], select(is[1], w[2], w[0]));
    b = select(is[0], w[2], select(is[1], w[0], w[1]));
  }

  HWY_INLINE void set_scale(const Bravais& lattice) {
    scale[0] = all(1) / (across * all(lattice.radius));
    scale[1] = scale[0] / Sqrt(v2);
    inverse_r = 1 / lattice.radius;
  }

  HWY_INLINE void set_axes_of_shape(const Bravais& lattice) {
    const Shape& shape = lattice.shape;
    set_along(shape);
    V w[3];
    for (int i = 0; i < 3; ++i) {
      w[i] = all(shape.to_ball[i][0]) * v[0];
      for (int k = 1; k < 3; ++k) w[i] = w[i] + all(shape.to_ball[i][k]) * v[k];
    }
    M is[3];
    V a, b, c;
    choose_axes(w, is, a, b, c);
    const V across2 = a * a + b * b;
    across = Sqrt(across2);
    const V speed = Sqrt(v2), ac = Neg(a * c), bc = Neg(b * c);
    scale[0] = all(1) / (across * all(lattice.radius) * speed);
    scale[1] = scale[0] / speed;
    V f[2][3];
    for (int k = 0; k < 3; ++k) {
      const M is_a = is[(k + 2) % 3];
      f[0][k] = IfThenZeroElse(is[k], select(is_a, Neg(b), a));
      f[1][k] = select(is[k], across2, select(is_a, ac, bc));
    }
    for (int i = 0; i < 2; ++i) set_across(shape, f[i], cartesian[i]);
    const double size = std::sqrt(shape.metric_size);
    inverse_r = size * shape.condition / lattice.radius;
    along_size = shape.metric_size > 1 ? shape.metric_size : 1;
    scale_error = kScale * kRoundoff * shape.condition;
  }

  HWY_INLINE void set_along(const Shape& shape) {
    Pair square = Pair(none());
    for (int i = 0; i < 3; ++i) {
      Pair image = first_product(Pair(shape.metric[i][0]), v[0]);
      for (int k = 1; k < 3; ++k) image = add_product(image, Pair(shape.metric[i][k]), v[k]);
      cartesian[2][i] = along[i] = image;
      square = add_product(square, image, v[i]);
    }
    v2 = square.hi;
  }

  // g x v, with g = C^T f.
  HWY_INLINE void set_across(const Shape& shape, const V (&f)[3], Pair (&axis)[3]) const {
    V g[3];
    for (int k = 0; k < 3; ++k) {
      g[k] = all(shape.cofactor[0][k]) * f[0];
      for (int j = 1; j < 3; ++j) g[k] = g[k] + all(shape.cofactor[j][k]) * f[j];
    }
    for (int k = 0; k < 3; ++k) {
      const int j = (k + 1) % 3, l = (k + 2) % 3;
      axis[k] = Pair::product(g[j], v[l]) - Pair::product(g[l], v[j]);
    }
  }

  HWY_INLINE void set_forms(const Bravais& lattice) {
    for (int i = 0; i < 3; ++i) {
      if constexpr (kUnit) {
        for (int k = 0; k < 3; ++k) form[k][i] = cartesian[k][i];
        size_of[i] = 1;
      } else {
        const WideVec& B = lattice.basis[i];
        const Pair b[3] = {Pair(B[0]), Pair(B[1]), Pair(B[2])};
        Pair f[3];
        forms_of(b, f);
        for (int k = 0; k < 3; ++k) form[k][i] = f[k];
        size_of[i] =
            std::fabs(B[0].hi) + std::fabs(B[1].hi) + std::fabs(B[2].hi) + kBasisInSize * lattice.basis_error;
      }
    }
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace lorentz
HWY_AFTER_NAMESPACE();

#endif
