// The first ball of a 3D Bravais lattice that a line meets, in O(log 1/r). Private to the reduction engine.
//
// Coordinates: across the line in units of r, along it in units of a length that grows while nothing is met.
// In these the cylinder is of radius 1, a window of it of length 1, and a basis that is short in them has few
// lattice planes and few lattice lines that meet the window. A line is solved by one quadratic.
#pragma once

#include <algorithm>

#include "src/engines/reduction/formulas.hpp"
#include "src/engines/reduction/offset.hpp"

namespace lorentz {

/// A lattice vector: integer coefficients in the lattice's short basis; across (units of r) and along.
struct Arm3 {
  double n[3]{};
  double p[2]{};
  double z = 0;
  double floor = 0;  ///< what the cancellation of large terms leaves of error, in units of the roundoff

  void subtract(double k, const Arm3& other) {
    for (int i = 0; i < 3; ++i) n[i] -= k * other.n[i];
    p[0] -= k * other.p[0], p[1] -= k * other.p[1];
    z -= k * other.z;
  }
};

inline double product(const Arm3& a, const Arm3& b) {
  return a.p[0] * b.p[0] + a.p[1] * b.p[1] + a.z * b.z;
}

/// Three vectors, shortest first, and what the enumeration needs of their dual basis.
struct Basis3 {
  Arm3 b[3];
  double length = 0;     ///< of a window, in units of s = v . d
  double dual[3][3]{};   ///< dual_i . b_j = delta_ij, in (p_0, p_1, z)
  double g = 0, e[2]{};  ///< dual_2 across the line: length and direction
  double inverse_g = 0;
  double g1_e = 0, g1_f = 0;  ///< dual_1 across: along e, and perpendicular to it
  double tilt_error = 0;      ///< of dual_2's component along the line
  bool usable = false;        ///< integers below 2^53, and nearly orthogonal: |b_i| |dual_i| <= 8
};

/// A lattice seen along one direction: all that does not depend on the start.
template <bool kUnit, bool kBall>
struct Direction3 {
  static constexpr bool kTurned = kUnit && kBall;

  Vec v;                   ///< turned, components below kTinyComponent taken as zero
  double v2 = 0, rho = 0;  ///< in the metric of the shape: |v|^2, r |v|
  double s_rho = 0;        ///< rho, by the name that it has in 2D
  double scale[2]{};       ///< across = scale * (form . n)
  double across_ = 0;      ///< of a ball's frame: the length of the first vector
  double inverse_r = 0;    ///< a vector of this size has an across of 1 at most, and its terms
  double scale_error = kScale * kRoundoff;  ///< of |across|^2, relative, from the scale
  double along_size = 1;                    ///< a vector of size 1 has an s of 4 times this at most
  Wide along[3];                            ///< s = along . d; not used for balls, whose s is v . d
  Wide cartesian[3][3]{};                   ///< across 0, across 1, along: of the axes
  Wide form[3][3]{};                        ///< the same of each vector of the short basis
  double size_of[3]{};                      ///< the size of each vector of the short basis
  Basis3 basis;

  template <class Arch>
  Direction3(Arch, const Bravais& lattice, const Octant& octant, const Vec& velocity) {
    octant.turn<kTurned>(velocity, v);
    if constexpr (kBall)
      set_frame<Arch>(lattice);
    else
      set_frame_of_shape<Arch>(lattice);
    s_rho = rho = width_of(lattice.radius, v2);
    set_forms<Arch>(lattice);
    basis.length = first_length(lattice);
    const double along = 1 / basis.length;
    for (int i = 0; i < 3; ++i) {
      Arm3& arm = basis.b[i];
      arm.n[i] = 1;
      arm.p[0] = scale[0] * form[0][i].hi, arm.p[1] = scale[1] * form[1][i].hi, arm.z = along * form[2][i].hi;
    }
    reduce<Arch>(basis);
  }

  /// Another atom of the same lattice, with balls of another radius: only the scales differ, and the basis is
  /// reduced on from where it is.
  template <class Arch>
  void retarget(const Bravais& lattice) {
    static_assert(kBall);
    const double before = inverse_r, length_before = basis.length;
    s_rho = rho = width_of(lattice.radius, v2);
    set_scale(lattice);
    basis.length = first_length(lattice);
    const double wider = inverse_r / before, longer = length_before / basis.length;
    for (Arm3& arm : basis.b) arm.p[0] *= wider, arm.p[1] *= wider, arm.z *= longer;
    reduce<Arch>(basis);
  }

  /// A longer window: the basis is reduced on from where it is.
  template <class Arch>
  void lengthen(Basis3& longer, double factor) const {
    longer.length *= factor;
    for (Arm3& arm : longer.b) arm.z /= factor;
    reduce<Arch>(longer);
  }

  /// A vector's across and along from its coefficients: the large terms cancel exactly.
  template <class Arch>
  void recompute(Arm3& arm, double length) const {
    arm.p[0] = scale[0] * compensated_sum<DoubleDouble<Arch>>(form[0], arm.n);
    arm.p[1] = scale[1] * compensated_sum<DoubleDouble<Arch>>(form[1], arm.n);
    arm.z = compensated_sum<DoubleDouble<Arch>>(form[2], arm.n) / length;
    double terms = 0;
    for (int j = 0; j < 3; ++j) terms += std::fabs(arm.n[j]) * size_of[j];
    arm.floor = kAnchorTerms / kRoundoff * kForm * inverse_r * terms;
  }

  /// Across (twice) and along of a Cartesian vector.
  template <class Arch>
  void forms_of(const Wide (&d)[3], Wide (&f)[3]) const {
    using DD = DoubleDouble<Arch>;
    for (int i = 0; i < 3; ++i) {
      const auto& c = cartesian[i];
      const DD x = DD::product(d[0].hi, c[0].hi), y = DD::product(d[1].hi, c[1].hi),
               z = DD::product(d[2].hi, c[2].hi);
      const DD xy = DD::sum(x.hi, y.hi), all = DD::sum(xy.hi, z.hi);
      double low = (x.lo + y.lo) + z.lo;
      for (int k = 0; k < 3; ++k) low += d[k].hi * c[k].lo + d[k].lo * c[k].hi;
      f[i] = Wide(DD::sum(all.hi, (xy.lo + all.lo) + low));
    }
  }

 private:
  // Two vectors across the line, exactly perpendicular to it and to each other, and v itself.
  template <class Arch>
  void set_frame(const Bravais& lattice) {
    using DD = DoubleDouble<Arch>;
    v2 = speed_squared(v[0], v[1], v[2]);
    int c = 0;
    if constexpr (kTurned)
      c = 2;  // the first octant
    else
      c = smallest_component(v);
    const int a = (c + 1) % 3, b = (c + 2) % 3;
    const double across2 = sum_of_products(v[a], v[a], v[b], v[b]), across = std::sqrt(across2);
    across_ = across;
    set_scale(lattice);
    cartesian[0][a] = Wide(-v[b]), cartesian[0][b] = Wide(v[a]);
    cartesian[1][a] = Wide(-DD::product(v[a], v[c])), cartesian[1][b] = Wide(-DD::product(v[b], v[c]));
    cartesian[1][c] = Wide(DD::product(v[a], v[a]) + DD::product(v[b], v[b]));
    for (int k = 0; k < 3; ++k) cartesian[2][k] = Wide(v[k]);
  }

  void set_scale(const Bravais& lattice) {
    scale[0] = first_scale(1.0, across_, lattice.radius);
    scale[1] = scale[0] / std::sqrt(v2);
    inverse_r = 1 / lattice.radius;
  }

  // Of a window in which two balls are expected.
  double first_length(const Bravais& lattice) const {
    return kWindowCells * lattice.volume / (3.14 * lattice.radius * lattice.radius) * std::sqrt(v2);
  }

  // The same in the metric of a shape. With f_i orthonormal and perpendicular to w = N v, across is
  //   f_i . C (v x d) / (r |w|) = ((C^T f_i) x v) . d / (r |w|),
  // where f_i and C^T f_i need not be exact: whatever g = C^T f_i is rounded to, g x v is perpendicular to v,
  // so that errors do not grow with the distance.
  template <class Arch>
  void set_frame_of_shape(const Bravais& lattice) {
    using DD = DoubleDouble<Arch>;
    const Shape& shape = lattice.shape;
    Wide image[3];
    apply_metric<Arch>(shape, v, image);
    DD square(0.0);
    for (int k = 0; k < 3; ++k) {
      cartesian[2][k] = along[k] = image[k];
      square = add_product(square, DD(image[k]), v[k]);
    }
    v2 = square.hi;
    Vec w{}, f[2]{};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) w[i] += shape.to_ball[i][k] * v[k];
    const int c = smallest_component(w), a = (c + 1) % 3, b = (c + 2) % 3;
    const double across2 = w[a] * w[a] + w[b] * w[b], across = std::sqrt(across2);
    f[0][a] = -w[b], f[0][b] = w[a];
    f[1][a] = -(w[a] * w[c]), f[1][b] = -(w[b] * w[c]), f[1][c] = across2;
    const double speed = std::sqrt(v2);
    scale[0] = 1 / (across * lattice.radius * speed);
    scale[1] = scale[0] / speed;
    for (int i = 0; i < 2; ++i) {
      Vec g{};
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j) g[k] += shape.cofactor[j][k] * f[i][j];
      for (int k = 0; k < 3; ++k) {
        const int j = (k + 1) % 3, l = (k + 2) % 3;
        cartesian[i][k] = Wide(DD::product(g[j], v[l]) - DD::product(g[l], v[j]));
      }
    }
    const double size = std::sqrt(shape.metric_size);
    inverse_r = size * shape.condition / lattice.radius;
    along_size = std::max(1.0, shape.metric_size);
    scale_error *= shape.condition;
  }

  static int smallest_component(const Vec& a) {
    int c = 0;
    for (int i = 1; i < 3; ++i)
      if (std::fabs(a[i]) < std::fabs(a[c])) c = i;
    return c;
  }

  // What each vector of the short basis has across and along.
  template <class Arch>
  void set_forms(const Bravais& lattice) {
    for (int i = 0; i < 3; ++i) {
      if constexpr (kUnit) {
        for (int k = 0; k < 3; ++k) form[k][i] = cartesian[k][i];
        size_of[i] = 1;
      } else {
        const Wide B[3] = {lattice.basis[i][0], lattice.basis[i][1], lattice.basis[i][2]};
        Wide f[3];
        forms_of<Arch>(B, f);
        for (int k = 0; k < 3; ++k) form[k][i] = f[k];
        size_of[i] =
            std::fabs(B[0].hi) + std::fabs(B[1].hi) + std::fabs(B[2].hi) + kBasisInSize * lattice.basis_error;
      }
    }
  }

 public:
  /// The state of a reduction: how large the integers ever were, and whether the coordinates are running
  /// sums.
  struct Progress {
    double largest = 0;  ///< of the coefficients; below 2^52 all steps were exact
    double limit = kRunningCoefficient;
    bool fresh = true;  ///< the coordinates are those of the coefficients, not sums of rounded ones
  };

  // Pairwise reduction to a basis that is short in the window's metric, then once more from exact
  // coefficients.
  template <class Arch>
  void reduce(Basis3& basis) const {
    Progress progress;
    Arm3* order[3] = {&basis.b[0], &basis.b[1], &basis.b[2]};
    bool done = false;
    for (int round = 0; round < kMaxReductionRounds && !done; ++round) {
      done = greedy(order, progress) && (progress.fresh || progress.largest * inverse_r < kGoodRunning);
      for (Arm3& arm : basis.b) recompute<Arch>(arm, basis.length);
      progress.fresh = true;
      progress.limit = kNoLimit;
    }
    const Arm3 sorted[3] = {*order[0], *order[1], *order[2]};
    std::copy(sorted, sorted + 3, basis.b);
    set_dual(basis);
    basis.usable = basis.usable && done && progress.largest < kMaxCoefficient / 2;
  }

  static void subtract(Arm3& arm, double k, const Arm3& other, Progress& progress) {
    arm.subtract(k, other);
    progress.largest =
        std::max({progress.largest, std::fabs(arm.n[0]), std::fabs(arm.n[1]), std::fabs(arm.n[2])});
  }

  // Greedy reduction: the two shorter vectors by Lagrange's step, then the longest by the nearest point of
  // their plane. False if it was interrupted, because the coordinates have to be computed anew.
  static bool greedy(Arm3* (&b)[3], Progress& progress) {
    double size[3];
    for (int i = 0; i < 3; ++i) size[i] = product(*b[i], *b[i]);
    sort(b, size);
    for (int step = 0; step < kMaxReductionSteps; ++step) {
      double c01 = product(*b[0], *b[1]);
      const double k = std::nearbyint(c01 / size[0]);
      if (k != 0) {
        if (std::fabs(k) > kRunningQuotient && !progress.fresh) return false;
        subtract(*b[1], k, *b[0], progress);
        progress.fresh = false;
        size[1] = product(*b[1], *b[1]);
        if (size[1] < size[0]) {
          std::swap(b[0], b[1]);
          std::swap(size[0], size[1]);
          continue;
        }
        c01 = product(*b[0], *b[1]);
      }
      const double c02 = product(*b[0], *b[2]), c12 = product(*b[1], *b[2]);
      const double inverse = 1 / (size[0] * size[1] - c01 * c01);
      const double k0 = std::nearbyint((c02 * size[1] - c12 * c01) * inverse);
      const double k1 = std::nearbyint((c12 * size[0] - c02 * c01) * inverse);
      if (k0 == 0 && k1 == 0) return true;
      if (std::max(std::fabs(k0), std::fabs(k1)) > kRunningQuotient && !progress.fresh) return false;
      subtract(*b[2], k0, *b[0], progress);
      subtract(*b[2], k1, *b[1], progress);
      const double before = size[2];
      size[2] = product(*b[2], *b[2]);
      progress.fresh = false;
      if (!(size[2] < before)) return true;
      if (size[2] >= size[1]) return true;
      if (progress.largest > progress.limit) return false;
      sort(b, size);
    }
    return false;
  }

  static void sort(Arm3* (&b)[3], double (&size)[3]) {
    const auto order = [&](int i, int j) {  // without a branch
      const bool swap = size[j] < size[i];
      Arm3* const first = swap ? b[j] : b[i];
      b[j] = swap ? b[i] : b[j], b[i] = first;
      const double smaller = swap ? size[j] : size[i];
      size[j] = swap ? size[i] : size[j], size[i] = smaller;
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
  }

  void set_dual(Basis3& basis) const {
    auto& b = basis.b;
    for (Arm3& arm : b)
      if (arm.z < 0) {
        for (double& n : arm.n) n = -n;
        arm.p[0] = -arm.p[0], arm.p[1] = -arm.p[1], arm.z = -arm.z;
      }
    for (int i = 0; i < 3; ++i) {
      const Arm3 &x = b[(i + 1) % 3], &y = b[(i + 2) % 3];
      basis.dual[i][0] = difference_of_products(x.p[1], y.z, x.z, y.p[1]);
      basis.dual[i][1] = difference_of_products(x.z, y.p[0], x.p[0], y.z);
      basis.dual[i][2] = difference_of_products(x.p[0], y.p[1], x.p[1], y.p[0]);
    }
    const double inverse = 1 / sum_of_products(b[0].p[0], basis.dual[0][0], b[0].p[1], basis.dual[0][1],
                                               b[0].z, basis.dual[0][2]);
    for (auto& row : basis.dual)
      for (double& component : row) component *= inverse;
    basis.usable = true;
    for (int i = 0; i < 3; ++i) {
      const auto& g = basis.dual[i];
      const double defect = product(b[i], b[i]) * (g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
      basis.usable = basis.usable && defect <= kMaxDefect * kMaxDefect;  // and no NaN
      for (const double n : b[i].n) basis.usable = basis.usable && std::fabs(n) < kMaxCoefficient;
    }
    const auto& g2 = basis.dual[2];
    const auto& g1 = basis.dual[1];
    basis.g = std::sqrt(sum_of_products(g2[0], g2[0], g2[1], g2[1]));
    const auto reach = [](const Arm3& arm) { return std::fabs(arm.p[0]) + std::fabs(arm.p[1]) + arm.floor; };
    basis.tilt_error = kTilt * kRoundoff * reach(b[0]) * reach(b[1]) * std::fabs(inverse);
    basis.inverse_g = 1 / basis.g;
    basis.e[0] = g2[0] * basis.inverse_g, basis.e[1] = g2[1] * basis.inverse_g;
    basis.g1_e = g1[0] * basis.e[0] + g1[1] * basis.e[1];
    basis.g1_f = g1[1] * basis.e[0] - g1[0] * basis.e[1];
  }
};

}  // namespace lorentz
