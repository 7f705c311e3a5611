// The formulas whose rounding errors decide, as templates on the number type: the engine for one flight runs
// them on binary64 (and on double-double), the batch engine on numbers in lanes, and
// tests/engines/bounds_test.cpp on numbers that carry their error. The bounds of these errors are in
// bounds.hpp, the derivations in docs/bounds.md. The text of formulas.hpp.

template <class A, class B>
LORENTZ_INLINE auto sum_of_products(const A& a0, const B& b0, const A& a1, const B& b1) {
  return a0 * b0 + a1 * b1;
}

template <class A, class B>
LORENTZ_INLINE auto sum_of_products(const A& a0, const B& b0, const A& a1, const B& b1, const A& a2,
                                    const B& b2) {
  return (a0 * b0 + a1 * b1) + a2 * b2;
}

template <class A, class B>
LORENTZ_INLINE auto difference_of_products(const A& a0, const B& b0, const A& a1, const B& b1) {
  return a0 * b0 - a1 * b1;
}

/// |d|^2.
template <int D, class T>
LORENTZ_INLINE T square_of(const T (&d)[D]) {
  T sum = d[0] * d[0];
  for (int k = 1; k < D; ++k) sum = sum + d[k] * d[k];
  return sum;
}

/// a . b.
template <int D, class T>
LORENTZ_INLINE T product_of(const T (&a)[D], const T (&b)[D]) {
  T sum = a[0] * b[0];
  for (int k = 1; k < D; ++k) sum = sum + a[k] * b[k];
  return sum;
}

/// a x b; in the plane its third component alone.
template <class T>
LORENTZ_INLINE void cross_of(const T (&a)[2], const T (&b)[2], T (&c)[1]) {
  c[0] = difference_of_products(a[0], b[1], a[1], b[0]);
}
template <class T>
LORENTZ_INLINE void cross_of(const T (&a)[3], const T (&b)[3], T (&c)[3]) {
  for (int k = 0; k < 3; ++k)
    c[k] = difference_of_products(a[(k + 1) % 3], b[(k + 2) % 3], a[(k + 2) % 3], b[(k + 1) % 3]);
}

/// d . G d, from the high parts of G.
template <int D, class Matrix, class T>
LORENTZ_INLINE T form_of(const Matrix& G, const T (&d)[D]) {
  T sum = G[0][0].hi * d[0] * d[0];
  for (int i = 0; i < D; ++i)
    for (int k = i == 0; k < D; ++k) sum = sum + G[i][k].hi * d[i] * d[k];
  return sum;
}

/// |v|^2 of a velocity, in 2D with a third component of zero.
template <class T>
LORENTZ_INLINE T speed_squared(const T& a, const T& b, const T& c) {
  return (a * a + b * b) + c * c;
}

/// (r |v|)^2.
template <class T>
LORENTZ_INLINE T squared_width_of(const T& r, const T& v2) {
  return (r * r) * v2;
}

/// r |v|.
template <class T>
LORENTZ_INLINE T width_of(const T& r, const T& v2) {
  return r * sqrt(v2);
}

// ---- Starts and cells -------------------------------------------------------------------------------------

/// a x b.
template <class V>
LORENTZ_INLINE V cross_product(const V& a, const V& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// b_0 . (b_1 x b_2).
template <class V>
LORENTZ_INLINE auto volume_of(const V& b0, const V& b1_x_b2) {
  return sum_of_products(b0[0], b1_x_b2[0], b0[1], b1_x_b2[1], b0[2], b1_x_b2[2]);
}

/// What the steps of a lattice vector and the offset of the home cell add up to, in double-double.
template <int D, class Wide>
LORENTZ_INLINE Wide place_after(const Wide (&step)[D], const Wide& offset) {
  Wide sum = step[0];
  for (int i = 1; i < D; ++i) sum = sum + step[i];
  return sum + offset;
}

// ---- 2D ---------------------------------------------------------------------------------------------------

/// The height over the line of the lattice point n R + m L from an anchor at height y, where R and L have the
/// heights D_R and -D_L.
template <class T>
LORENTZ_INLINE T height_in_row(const T& y, const T& n, const T& D_R, const T& m, const T& D_L) {
  return (y + n * D_R) - m * D_L;
}

/// Its position along the line, where R and L have the positions S_R and S_L.
template <class T>
LORENTZ_INLINE T sum_along(const T& s, const T& n, const T& S_R, const T& m, const T& S_L) {
  return (s + n * S_R) + m * S_L;
}

/// The number of the row that passes the start, from the position s and height y of the ball that rows are
/// counted from; A = S_R D_L + S_L D_R.
template <class T>
LORENTZ_INLINE T row_number(const T& S_L, const T& y, const T& D_L, const T& s, const T& inverse_A) {
  return -(S_L * y + D_L * s) * inverse_A;
}

/// The m at which the row at height y enters the strip |h| < rho.
template <class T>
LORENTZ_INLINE T entry_of_row(const T& y, const T& rho, const T& inverse_D_L) {
  return (y - rho) * inverse_D_L;
}

/// The m at which row n passes the start.
template <class T>
LORENTZ_INLINE T passing_of_row(const T& s, const T& n, const T& S_R, const T& inverse_S_L) {
  return -(s + n * S_R) * inverse_S_L;
}

/// Rows that a unit of s passes.
template <class T>
LORENTZ_INLINE T row_slope(const T& D_L, const T& inverse_A) {
  return D_L * inverse_A;
}

/// h + n_0 H_0 + n_1 H_1. Large terms cancel exactly: a Pair is an exact product, or sum, of two numbers.
template <bool kLowParts, class Pair, class T, class Form>
LORENTZ_INLINE T compensated_height(const Pair& h, const T (&n)[2], const Form (&H)[2]) {
  const Pair a = Pair::product(n[0], H[0].hi), b = Pair::product(n[1], H[1].hi);
  const Pair ab = Pair::sum(a.hi, b.hi), all = Pair::sum(ab.hi, h.hi);
  T low = (a.lo + b.lo) + (ab.lo + all.lo) + h.lo;
  if constexpr (kLowParts) low = low + (n[0] * H[0].lo + n[1] * H[1].lo);
  return all.hi + low;
}

// ---- 3D ---------------------------------------------------------------------------------------------------

/// What the product n f leaves of f's low part, and of its own.
template <bool kLowParts, class Pair, class T, class Form>
LORENTZ_INLINE T low_of(const Pair& product, const T& n, const Form& f) {
  if constexpr (kLowParts)
    return product.lo + n * f.lo;
  else
    return product.lo;
}

/// n_0 f_0 + n_1 f_1 + n_2 f_2, likewise; or two terms, if f_2 is zero, or without low parts, if these are.
template <class Pair, int kTerms = 3, bool kLowParts = true, class T, class Form>
LORENTZ_INLINE T compensated_sum(const Form (&f)[3], const T (&n)[3]) {
  const Pair a = Pair::product(n[0], f[0].hi), b = Pair::product(n[1], f[1].hi), ab = Pair::sum(a.hi, b.hi);
  if constexpr (kTerms == 2)
    return ab.hi + (ab.lo + (low_of<kLowParts>(a, n[0], f[0]) + low_of<kLowParts>(b, n[1], f[1])));
  const Pair c = Pair::product(n[2], f[2].hi), all = Pair::sum(ab.hi, c.hi);
  return all.hi + ((ab.lo + all.lo) + (low_of<kLowParts>(a, n[0], f[0]) + low_of<kLowParts>(b, n[1], f[1]) +
                                       low_of<kLowParts>(c, n[2], f[2])));
}

/// The same from a start.
template <class Pair, int kTerms = 3, bool kLowParts = true, class T, class Form>
LORENTZ_INLINE T compensated_sum_from(const Form& start, const Form (&f)[3], const T (&n)[3]) {
  const Pair a = Pair::product(n[0], f[0].hi), b = Pair::product(n[1], f[1].hi), ab = Pair::sum(a.hi, b.hi);
  if constexpr (kTerms == 2) {
    const Pair all = Pair::sum(ab.hi, start.hi);
    return all.hi + ((ab.lo + (all.lo + start.lo)) + (a.lo + b.lo));
  } else {
    const Pair c = Pair::product(n[2], f[2].hi), abc = Pair::sum(ab.hi, c.hi),
               all = Pair::sum(abc.hi, start.hi);
    T low = c.lo;
    if constexpr (kLowParts) low = low + ((n[0] * f[0].lo + n[1] * f[1].lo) + n[2] * f[2].lo);
    return all.hi + (((ab.lo + abc.lo) + (all.lo + start.lo)) + ((a.lo + b.lo) + low));
  }
}

/// The same with coefficients in double-double.
template <class Pair, class Form>
LORENTZ_INLINE auto compensated_sum(const Form (&f)[3], const Form (&N)[3], const Form& start) {
  const Pair a = Pair::product(N[0].hi, f[0].hi), b = Pair::product(N[1].hi, f[1].hi),
             c = Pair::product(N[2].hi, f[2].hi);
  const Pair ab = Pair::sum(a.hi, b.hi), abc = Pair::sum(ab.hi, c.hi), all = Pair::sum(abc.hi, start.hi);
  auto low = N[0].hi * f[0].lo + N[0].lo * f[0].hi;
  for (int i = 1; i < 3; ++i) low = low + (N[i].hi * f[i].lo + N[i].lo * f[i].hi);
  return all.hi + (((ab.lo + abc.lo) + (all.lo + start.lo)) + ((a.lo + b.lo) + (c.lo + low)));
}

/// One across coordinate's scale: of the first form, whose length is `across`, with balls of radius r.
template <class T>
LORENTZ_INLINE T first_scale(const T& one, const T& across, const T& r) {
  return one / (across * r);
}

/// A coordinate of a point k steps on.
template <class T>
LORENTZ_INLINE T stepped(const T& base, const T& k, const T& step) {
  return base + k * step;
}

/// The moment of a lattice line about the flight, through q with steps a, across.
template <class T>
LORENTZ_INLINE T moment_of_line(const T (&q)[2], const T (&a)[2]) {
  return difference_of_products(q[0], a[1], q[1], a[0]);
}

/// How far off the line passes a lattice plane, in units of r.
template <class T>
LORENTZ_INLINE T distance_of_plane(const T& kappa, const T& tilt, const T& z, const T& inverse_g) {
  return (kappa - tilt * z) * inverse_g;
}

// ---- The shape of an ellipsoid ----------------------------------------------------------------------------

/// From the semiaxes, the rows of a: adj(A) and det(A); then N = (r / det) adj(A), G = N^T N, C = (r^2 / det)
/// A^T.
template <class Wide>
struct ShapeForms {
  Wide adjugate[3][3], det, factor, to_ball[3][3], metric[3][3], cofactor[3][3];

  template <class Rows>
  void set_adjugate(const Rows& a) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const auto &x = a[(i + 1) % 3], &y = a[(i + 2) % 3];
        const int k = (j + 1) % 3, l = (j + 2) % 3;
        adjugate[i][j] = Wide::product(x[k], y[l]) - Wide::product(x[l], y[k]);
      }
    det = Wide(0.0);
    for (int k = 0; k < 3; ++k) det = det + adjugate[0][k] * a[0][k];
  }

  template <class Rows>
  void set_forms(const Rows& a, double r) {
    factor = Wide(r) / det;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        to_ball[i][k] = adjugate[i][k] * factor;
        cofactor[i][k] = factor * r * a[i][k];
      }
  }

  void set_metric() {
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        metric[i][k] = Wide(0.0);
        for (int j = 0; j < 3; ++j) metric[i][k] = metric[i][k] + to_ball[j][i] * to_ball[j][k];
      }
  }
};

// ---- Times ------------------------------------------------------------------------------------------------

/// From s, the half chord q, and v^2.
template <class T>
LORENTZ_INLINE T rough_time_of(const T& s, const T& q, const T& v2) {
  return (s - q) / v2;
}
