// The lines of one lattice plane that meet the flight's cylinder, in 3D: the cylinder cuts the plane in a
// section of an ellipse. Private to the reduction engine.
#pragma once

#include <algorithm>

#include "src/engines/reduction/thin_section_3d.hpp"

namespace lorentz {

template <class Arch, bool kUnit, bool kBall>
class Planes3 {
  using Window = Window3<Arch, kUnit, kBall>;
  using Candidates = Candidates3<Arch, kUnit, kBall>;
  using Lines = Lines3<Arch, kUnit, kBall>;

 public:
  bool none_met = true;

  Planes3(const Window& window, const Candidates& candidates, Lines& lines)
      : window_(window), candidates_(candidates), lines_(lines) {}

  /// The plane of this point. In the coordinates xi (along the normal), eta (across it), z it is slope xi +
  /// tilt z = kappa. False: undecided.
  bool scan(const Point3& point, double kappa) {
    const Basis3& basis = *window_.basis;
    const double tilt = basis.tilt();
    double z_first = window_.z_first;
    double z_last = candidates_.end();
    if (!cut(kappa, z_first, z_last)) return true;
    none_met = false;
    const double xi_first = distance_of_plane(kappa, tilt, z_first, basis.inverse_slope);
    const double xi_last = distance_of_plane(kappa, tilt, z_last, basis.inverse_slope);
    const double nearest = nearest_of(xi_first, xi_last);
    const double error = xi_error(point);
    const double eta = std::sqrt(std::max(0.0, 1 - nearest * nearest) + 2 * error) + kSlop3d;
    const auto& g1 = basis.dual[1];
    const double a = basis.dual1_normal * xi_first + g1[2] * z_first;
    const double b = basis.dual1_normal * xi_last + g1[2] * z_last;
    const double here = g1[0] * point.p[0] + g1[1] * point.p[1] + g1[2] * point.z;
    const double half = std::fabs(basis.dual1_level) * eta;
    const double spread = kSlop3d * (1 + std::fabs(basis.dual1_normal) + std::fabs(g1[2]));
    const double low = std::ceil(std::min(a, b) - half - here - spread);
    const double high = std::max(a, b) + half - here + spread;
    if (!are_countable(low, high)) return false;
    if (high - low > kManyLines)
      return ThinSection3<Arch, kUnit, kBall>(window_, candidates_, lines_)
          .scan(point, z_first, z_last, kappa, error);
    for (double k = low; k <= high; ++k)
      if (!lines_.scan(Point3(point, k, basis.b[1]), basis.b[0], z_first, z_last)) return false;
    return true;
  }

 private:
  // The part of the window in which the plane is within r of the line; false if there is none.
  bool cut(double kappa, double& z_first, double& z_last) const {
    const double tilt = window_.basis->tilt();
    const double at_first = kappa - tilt * z_first;
    const double at_last = kappa - tilt * z_last;
    const double slope = window_.basis->slope * (1 + kSlop3d);
    if (!(std::fabs(at_first) > slope || std::fabs(at_last) > slope)) return true;
    if ((at_first > slope && at_last > slope) || (at_first < -slope && at_last < -slope)) return false;
    const double one = (kappa - slope) / tilt;
    const double other = (kappa + slope) / tilt;
    z_first = std::max(z_first, std::min(one, other) - kSlop3d);
    z_last = std::min(z_last, std::max(one, other) + kSlop3d);
    return !(z_first > z_last);
  }

  // By how much xi, where the line passes the plane of this point, may be off. A plane that the line passes
  // at nearly the radius leaves a section of the half width sqrt(1 - xi^2), whose square is off by twice
  // that: more than all of it, when the section is thin.
  double xi_error(const Point3& point) const {
    const Basis3& basis = *window_.basis;
    const auto& g = basis.dual[2];
    const double terms =
        1 + std::max(std::fabs(g[0]), std::fabs(g[1])) * point.size + std::fabs(g[2]) * point.extent;
    return window_.p_error + window_.to.scale_error +
           basis.inverse_slope * (basis.tilt_error + std::fabs(g[2]) * window_.s_error / basis.length +
                                  kPlane * kRoundoff * terms);
  }

  const Window& window_;
  const Candidates& candidates_;
  Lines& lines_;
};

}  // namespace lorentz
