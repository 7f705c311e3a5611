// A short basis of a 3D lattice as seen along a line, and what the enumeration of its planes and lines needs
// of the dual basis. Private to the reduction engine.
#pragma once

#include <cmath>

#include "src/engines/reduction/bounds.hpp"
#include "src/engines/reduction/formulas.hpp"

namespace lorentz {

/// A lattice vector: integer coefficients in the lattice's short basis; across (units of r) and along. (Like
/// a double, it is not set unless said so: so are the structures below.)
struct Arm3 {
  double n[3];
  double p[2], z;
  double cancellation;  ///< what the cancelling of large terms leaves of error, in units of the roundoff

  void subtract(double k, const Arm3& other) {
    for (int i = 0; i < 3; ++i) n[i] -= k * other.n[i];
    p[0] -= k * other.p[0], p[1] -= k * other.p[1];
    z -= k * other.z;
  }

  void point_forward() {  // without a branch: half of all vectors do not
    const double sign = 1 - 2 * static_cast<double>(z < 0);
    for (double& coefficient : n) coefficient *= sign;
    p[0] *= sign, p[1] *= sign, z *= sign;
  }
};

inline double product(const Arm3& a, const Arm3& b) {
  return a.p[0] * b.p[0] + a.p[1] * b.p[1] + a.z * b.z;
}

/// Three vectors, shortest first. Planes of the lattice are spanned by the first two; dual_2 is normal to
/// them.
struct Basis3 {
  Arm3 b[3];
  double length;                     ///< of a window, in units of s = v . d
  double dual[3][3];                 ///< dual_i . b_j = delta_ij, in (p_0, p_1, z)
  double slope, inverse_slope;       ///< of dual_2 across the line: its length there
  double normal[2];                  ///< and its direction
  double dual1_normal, dual1_level;  ///< dual_1 across: along the normal, and perpendicular to it
  double tilt_error;                 ///< of dual_2's component along the line
  bool usable;                       ///< integers below 2^53, and nearly orthogonal (kMaxDefect)

  /// dual_2's component along the line.
  double tilt() const { return dual[2][2]; }

  /// From the three vectors, which are turned to point forward.
  void set_dual() {
    for (Arm3& arm : b) arm.point_forward();
    const double inverse_volume = set_dual_vectors();
    usable = is_nearly_orthogonal();
    set_normal();
    const auto reach = [](const Arm3& arm) {
      return std::fabs(arm.p[0]) + std::fabs(arm.p[1]) + arm.cancellation;
    };
    tilt_error = kTilt * kRoundoff * reach(b[0]) * reach(b[1]) * std::fabs(inverse_volume);
  }

 private:
  double set_dual_vectors() {
    for (int i = 0; i < 3; ++i) {
      const Arm3 &x = b[(i + 1) % 3], &y = b[(i + 2) % 3];
      dual[i][0] = difference_of_products(x.p[1], y.z, x.z, y.p[1]);
      dual[i][1] = difference_of_products(x.z, y.p[0], x.p[0], y.z);
      dual[i][2] = difference_of_products(x.p[0], y.p[1], x.p[1], y.p[0]);
    }
    const double inverse =
        1 / sum_of_products(b[0].p[0], dual[0][0], b[0].p[1], dual[0][1], b[0].z, dual[0][2]);
    for (auto& row : dual)
      for (double& component : row) component *= inverse;
    return inverse;
  }

  bool is_nearly_orthogonal() const {
    bool nearly = true;
    for (int i = 0; i < 3; ++i) {
      const double defect = product(b[i], b[i]) * square_of(dual[i]);
      nearly &= defect <= kMaxDefect * kMaxDefect;  // and no NaN
      for (const double n : b[i].n) nearly &= std::fabs(n) < kMaxCoefficient;
    }
    return nearly;
  }

  void set_normal() {
    const auto &g1 = dual[1], &g2 = dual[2];
    slope = std::sqrt(sum_of_products(g2[0], g2[0], g2[1], g2[1]));
    inverse_slope = 1 / slope;
    normal[0] = g2[0] * inverse_slope, normal[1] = g2[1] * inverse_slope;
    dual1_normal = g1[0] * normal[0] + g1[1] * normal[1];
    dual1_level = g1[1] * normal[0] - g1[0] * normal[1];
  }
};

}  // namespace lorentz
