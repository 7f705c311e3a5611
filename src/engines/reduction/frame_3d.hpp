// Coordinates of a 3D lattice as seen along a velocity: two across the line, in units of r, and one along it.
// Private to the reduction engine.
#pragma once

#include <algorithm>

#include "src/engines/reduction/basis_3d.hpp"
#include "src/engines/reduction/formulas.hpp"
#include "src/engines/reduction/offset.hpp"

namespace lorentz {

template <bool kUnit, bool kBall>
struct Frame3 {
  static constexpr bool kTurned = kUnit && kBall;
  /// Of unit lattices of balls: the third term of the first form, and the low parts of the first and the
  /// last, are zero, and are left out.
  static constexpr int kFirstTerms = kTurned ? 2 : 3;
  static constexpr bool kLowParts = !kTurned;

  Vec v;             ///< turned, components below kTinyComponent taken as zero
  double v2, rho;    ///< in the metric of the shape: |v|^2, r |v|
  double s_rho;      ///< rho, by the name that it has in 2D
  double scale[2];   ///< across = scale * (form . n)
  double across_;    ///< of a ball's frame: the length of the first vector
  double inverse_r;  ///< a vector of this size has an across of 1 at most, and its terms
  double scale_error = kScale * kRoundoff;  ///< of |across|^2, relative, from the scale
  double along_size = 1;                    ///< a vector of size 1 has an s of 4 times this at most
  Wide along[3];                            ///< s = along . d; not used for balls, whose s is v . d
  Wide cartesian[3][3];                     ///< across 0, across 1, along: of the axes
  double size_of[3];                        ///< the size of each vector of the short basis

  template <class Arch>
  void set(const Bravais& lattice, const Vec& velocity) {
    for (int k = 0; k < 3; ++k) v[k] = velocity[k];
    if constexpr (kBall)
      set_axes<Arch>(lattice);
    else
      set_axes_of_shape<Arch>(lattice);
    s_rho = rho = width_of(lattice.radius, v2);
    set_forms<Arch>(lattice);
  }

  /// Across 0, across 1, along: of each vector of the short basis.
  const Wide (&form() const)[3][3] {
    if constexpr (kUnit)
      return cartesian;
    else
      return of_basis_;
  }

  /// For balls of another radius: only the scales differ.
  void set_radius(const Bravais& lattice) {
    static_assert(kBall);
    s_rho = rho = width_of(lattice.radius, v2);
    set_scale(lattice);
  }

  /// A vector's across and along from its coefficients: the large terms cancel exactly.
  template <class Arch>
  void recompute(Arm3& arm, double length) const {
    using DD = DoubleDouble<Arch>;
    arm.p[0] = scale[0] * compensated_sum<DD, kFirstTerms, kLowParts>(form()[0], arm.n);
    arm.p[1] = scale[1] * compensated_sum<DD>(form()[1], arm.n);
    arm.z = compensated_sum<DD, 3, kLowParts>(form()[2], arm.n) / length;
    double terms = 0;
    for (int j = 0; j < 3; ++j) terms += std::fabs(arm.n[j]) * size_of[j];
    arm.cancellation = kAnchorTerms / kRoundoff * kForm * inverse_r * terms;
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
      for (int k = 0; k < 3; ++k) {
        if constexpr (kUnit)  // whose starts have no low parts
          low += d[k].hi * c[k].lo;
        else
          low += d[k].hi * c[k].lo + d[k].lo * c[k].hi;
      }
      f[i] = Wide(DD::sum(all.hi, (xy.lo + all.lo) + low));
    }
  }

 private:
  // Two vectors across the line, exactly perpendicular to it and to each other, and v itself.
  template <class Arch>
  void set_axes(const Bravais& lattice) {
    using DD = DoubleDouble<Arch>;
    v2 = speed_squared(v[0], v[1], v[2]);
    int c = 0;
    if constexpr (kTurned)
      c = 2;  // the first octant
    else
      c = smallest_component(v);
    const int a = (c + 1) % 3, b = (c + 2) % 3;
    across_ = std::sqrt(sum_of_products(v[a], v[a], v[b], v[b]));
    set_scale(lattice);
    cartesian[0][a] = Wide(-v[b]), cartesian[0][b] = Wide(v[a]), cartesian[0][c] = Wide(0.0);
    cartesian[1][a] = Wide(-DD::product(v[a], v[c])), cartesian[1][b] = Wide(-DD::product(v[b], v[c]));
    cartesian[1][c] = Wide(DD::product(v[a], v[a]) + DD::product(v[b], v[b]));
    for (int k = 0; k < 3; ++k) cartesian[2][k] = Wide(v[k]);
  }

  void set_scale(const Bravais& lattice) {
    scale[0] = first_scale(1.0, across_, lattice.radius);
    scale[1] = scale[0] / std::sqrt(v2);
    inverse_r = 1 / lattice.radius;
  }

  // The same in the metric of a shape. With f_i orthonormal and perpendicular to w = N v, across is
  //   f_i . C (v x d) / (r |w|) = ((C^T f_i) x v) . d / (r |w|),
  // where f_i and C^T f_i need not be exact: whatever g = C^T f_i is rounded to, g x v is perpendicular to v,
  // so that errors do not grow with the distance.
  template <class Arch>
  void set_axes_of_shape(const Bravais& lattice) {
    const Shape& shape = lattice.shape;
    set_along<Arch>(shape);
    Vec w{};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) w[i] += shape.to_ball[i][k] * v[k];
    const int c = smallest_component(w);
    const int a = (c + 1) % 3;
    const int b = (c + 2) % 3;
    const double across2 = w[a] * w[a] + w[b] * w[b];
    const double across = std::sqrt(across2);
    Vec f[2]{};
    f[0][a] = -w[b];
    f[0][b] = w[a];
    f[1][a] = -(w[a] * w[c]);
    f[1][b] = -(w[b] * w[c]);
    f[1][c] = across2;
    const double speed = std::sqrt(v2);
    scale[0] = 1 / (across * lattice.radius * speed);
    scale[1] = scale[0] / speed;
    for (int i = 0; i < 2; ++i) set_across<Arch>(shape, f[i], cartesian[i]);
    const double size = std::sqrt(shape.metric_size);
    inverse_r = size * shape.condition / lattice.radius;
    along_size = std::max(1.0, shape.metric_size);
    scale_error *= shape.condition;
  }

  // w = G v, and v2 = w . v.
  template <class Arch>
  void set_along(const Shape& shape) {
    using DD = DoubleDouble<Arch>;
    DD image[3], square(0.0);
    apply_metric(shape, v, image);
    for (int k = 0; k < 3; ++k) {
      cartesian[2][k] = along[k] = Wide(image[k]);
      square = add_product(square, image[k], v[k]);
    }
    v2 = square.hi;
  }

  // g x v, with g = C^T f.
  template <class Arch>
  void set_across(const Shape& shape, const Vec& f, Wide (&axis)[3]) const {
    using DD = DoubleDouble<Arch>;
    Vec g{};
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j) g[k] += shape.cofactor[j][k] * f[j];
    for (int k = 0; k < 3; ++k) {
      const int j = (k + 1) % 3, l = (k + 2) % 3;
      axis[k] = Wide(DD::product(g[j], v[l]) - DD::product(g[l], v[j]));
    }
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
        size_of[i] = 1;
      } else {
        const Wide B[3] = {lattice.basis[i][0], lattice.basis[i][1], lattice.basis[i][2]};
        Wide f[3];
        forms_of<Arch>(B, f);
        for (int k = 0; k < 3; ++k) of_basis_[k][i] = f[k];
        size_of[i] =
            std::fabs(B[0].hi) + std::fabs(B[1].hi) + std::fabs(B[2].hi) + kBasisInSize * lattice.basis_error;
      }
    }
  }

  Wide of_basis_[3][3];  // not on the unit lattices, whose basis is the axes
};

}  // namespace lorentz
