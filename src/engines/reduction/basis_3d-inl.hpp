// Short bases of a 3D lattice as seen along a line, and the parts of the dual basis that are needed to
// enumerate its planes and lines.

/// The integers of a search: numbers, which are exact below 2^53, or double-double, of which kMaxWideCell holds.
template <class Number>
LORENTZ_INLINE Number high_of(const Number& n) {
  return n;
}
template <class Numbers>
LORENTZ_INLINE typename Numbers::Number high_of(const DoubleDouble<Numbers>& n) {
  return n.hi;
}
template <class Integer>
inline constexpr double kLargest = std::is_same_v<Integer, Wide> ? kMaxWideCell : kMaxCoefficient;
/// How far the windows go, in s: in its cells the search counts exactly.
template <class Integer>
inline constexpr double kFarthest = std::is_same_v<Integer, Wide> ? kMaxWideCell : kMaxCell;

/// compensated_sum (formulas-inl.hpp) of coefficients in double-double.
template <class Pair, int kTerms = 3, bool kLowParts = true, class Arch, class Form>
LORENTZ_INLINE auto compensated_sum(const Form (&f)[3], const DoubleDouble<Arch> (&N)[3]) {
  return compensated_sum<Pair>(f, N, Form(all(0)));
}

/// A lattice vector: its integer coefficients in the lattice's short basis, and its components across the
/// line (in units of r) and along it. (Like a double it is not initialised by default. The same holds for the
/// structures below.)
template <class Numbers, class Integer = typename Numbers::Number>
struct ArmOf3 {
  using Number = typename Numbers::Number;

  Integer n[3];
  Number p[2], z;
  Number cancellation;  ///< the error left when large terms cancel, in units of the roundoff

  LORENTZ_INLINE void subtract(Number k, const ArmOf3& other) {
    for (int i = 0; i < 3; ++i) n[i] = n[i] - k * other.n[i];
    p[0] = p[0] - k * other.p[0], p[1] = p[1] - k * other.p[1];
    z = z - k * other.z;
  }

  LORENTZ_INLINE void point_forward() {
    const typename Numbers::Mask backward = z < all(0);
    for (Integer& coefficient : n) coefficient = NegIf(backward, coefficient);
    p[0] = NegIf(backward, p[0]), p[1] = NegIf(backward, p[1]), z = NegIf(backward, z);
  }

  LORENTZ_INLINE Number largest_coefficient() const {
    return Max(Max(Abs(high_of(n[0])), Abs(high_of(n[1]))), Abs(high_of(n[2])));
  }
};

template <class Numbers, class Integer>
LORENTZ_INLINE typename Numbers::Number product(const ArmOf3<Numbers, Integer>& a,
                                                const ArmOf3<Numbers, Integer>& b) {
  return a.p[0] * b.p[0] + a.p[1] * b.p[1] + a.z * b.z;
}

/// Three vectors, shortest first. The first two span the planes of the lattice; dual_2 is normal to these.
template <class Numbers, class Integer = typename Numbers::Number>
struct BasisOf3 {
  using Number = typename Numbers::Number;
  using Mask = typename Numbers::Mask;
  using Arm = ArmOf3<Numbers, Integer>;

  Arm b[3];
  Number length;                     ///< of a window, in units of s = v . d
  Number dual[3][3];                 ///< dual_i . b_j = delta_ij, in (p_0, p_1, z)
  Number slope, inverse_slope;       ///< of dual_2 across the line: the length there
  Number normal[2];                  ///< and its direction
  Number dual1_normal, dual1_level;  ///< dual_1 across: along the normal, and perpendicular to it
  Number tilt_error;                 ///< of dual_2's component along the line
  Number inverse_volume;             ///< of a cell
  Mask usable;                       ///< the integers are below kLargest; nearly orthogonal (kMaxDefect)

  /// dual_2's component along the line.
  LORENTZ_INLINE Number tilt() const { return dual[2][2]; }

  /// Sets the rest from the three vectors, which are turned to point forward.
  LORENTZ_INLINE void set_dual() {
    for (Arm& arm : b) arm.point_forward();
    inverse_volume = Abs(set_dual_vectors());
    set_usable();
    set_normal();
    tilt_error = kTilt * kRoundoff * reach(b[0]) * reach(b[1]) * inverse_volume;
  }

 private:
  static LORENTZ_INLINE Number reach(const Arm& arm) {
    return Abs(arm.p[0]) + Abs(arm.p[1]) + arm.cancellation;
  }

  LORENTZ_INLINE Number set_dual_vectors() {
    for (int i = 0; i < 3; ++i) {
      const Arm &x = b[(i + 1) % 3], &y = b[(i + 2) % 3];
      dual[i][0] = difference_of_products(x.p[1], y.z, x.z, y.p[1]);
      dual[i][1] = difference_of_products(x.z, y.p[0], x.p[0], y.z);
      dual[i][2] = difference_of_products(x.p[0], y.p[1], x.p[1], y.p[0]);
    }
    const Number inverse =
        1 / sum_of_products(b[0].p[0], dual[0][0], b[0].p[1], dual[0][1], b[0].z, dual[0][2]);
    for (auto& row : dual)
      for (Number& component : row) component = component * inverse;
    return inverse;
  }

  LORENTZ_INLINE void set_usable() {
    usable = everywhere(true);
    for (int i = 0; i < 3; ++i) {
      const Number defect = product(b[i], b[i]) * square_of(dual[i]);
      usable = And(usable, And(defect <= all(kMaxDefect * kMaxDefect),  // and no NaN
                               b[i].largest_coefficient() < all(kLargest<Integer>)));
    }
  }

  LORENTZ_INLINE void set_normal() {
    const Number(&g1)[3] = dual[1];
    const Number(&g2)[3] = dual[2];
    slope = sqrt(sum_of_products(g2[0], g2[0], g2[1], g2[1]));
    inverse_slope = 1 / slope;
    normal[0] = g2[0] * inverse_slope, normal[1] = g2[1] * inverse_slope;
    dual1_normal = g1[0] * normal[0] + g1[1] * normal[1];
    dual1_level = g1[1] * normal[0] - g1[0] * normal[1];
  }
};
