// A long, thin section of the flight's cylinder by a lattice plane, in 3D: the problem of the first ball in
// an ellipse of a 2D lattice. It is searched in parts, short at first and then each twice as long as the one
// before, with a basis of the plane that is short in the metric of the part. Private to the reduction engine.
#pragma once

#include <algorithm>
#include <utility>

#include "src/engines/reduction/lines_3d.hpp"

namespace lorentz {

template <class Arch, bool kUnit, bool kBall, class Integer>
class ThinSection3 {
  using Window = Window3<Arch, kUnit, kBall, Integer>;
  using Candidates = Candidates3<Arch, kUnit, kBall, Integer>;
  using Lines = Lines3<Arch, kUnit, kBall, Integer>;
  using Point = typename Window::Point;
  using Arm = typename Window::Arm;

 public:
  ThinSection3(const Window& window, const Candidates& candidates, Lines& lines)
      : window_(window), candidates_(candidates), lines_(lines) {}

  /// Scans the section, from a point of the plane. False: undecided.
  [[gnu::noinline]] bool scan(const Point& in_plane, double z_first, double z_last, double kappa,
                              double xi_error) {
    const typename Window::Basis& basis = *window_.basis;
    const double unsure = 2 * xi_error;
    Arm c[2] = {basis.b[0], basis.b[1]};
    const double cell = std::fabs(c[0].z * eta(c[1].p) - c[1].z * eta(c[0].p));
    double length = z_last - z_first;
    while (length * half_width(kappa, z_first, z_first + length, unsure) > kPartCells * cell) length /= 4;
    Point base = in_plane;
    for (double z = z_first; z < std::min(z_last, candidates_.end()); z += length, length *= 2) {
      const double z_next = std::min(z + length, z_last);
      const Part part{z, z_next, half_width(kappa, z, z_next, unsure)};
      if (!reduce_in_plane(c, 2 / (z_next - z), 1 / part.width)) return false;
      const double inverse = 1 / (c[0].z * eta(c[1].p) - c[1].z * eta(c[0].p));
      if (!move_to_middle(part, c, inverse, base)) return false;
      if (!scan_part(part, c, inverse, base, kSlop3d * length)) return false;
    }
    return true;
  }

 private:
  // A part of a section, and its half width.
  struct Part {
    double z, z_next, width;

    double middle() const { return z + 0.5 * (z_next - z); }
  };

  // The coordinate across the normal.
  double eta(const double* p) const {
    const double* normal = window_.basis->normal;
    return p[1] * normal[0] - p[0] * normal[1];
  }

  double half_width(double kappa, double z1, double z2, double unsure) const {
    const double tilt = window_.basis->tilt(), inverse = window_.basis->inverse_slope;
    const double nearest = Window::nearest_of(distance_of_plane(kappa, tilt, z1, inverse),
                                              distance_of_plane(kappa, tilt, z2, inverse));
    return std::sqrt(std::max(0.0, (1 - nearest) * (1 + nearest)) + unsure) + kSectionSlop;
  }

  // Moves `base` to a lattice point of the plane near the middle of the part; false if its integers were
  // rounded.
  bool move_to_middle(const Part& part, const Arm (&c)[2], double inverse, Point& base) const {
    for (int pass = 0; pass < 2; ++pass) {
      const double dz = part.middle() - base.z, dh = -eta(base.p);
      const double k0 = std::nearbyint((dz * eta(c[1].p) - c[1].z * dh) * inverse);
      const double k1 = std::nearbyint((c[0].z * dh - dz * eta(c[0].p)) * inverse);
      const Point moved = base.step(k0, c[0]).step(k1, c[1]);
      for (int i = 0; i < 3; ++i)
        if (!(std::fabs(high_of(base.n[i])) + std::fabs(k0 * high_of(c[0].n[i])) +
                  std::fabs(k1 * high_of(c[1].n[i])) <=
              kLargest<Integer>))
          return false;
      base = window_.recomputed(moved);
    }
    return true;
  }

  // Scans the lines of a part: k_1 = (c_0 x (point - base)) / (c_0 x c_1).
  bool scan_part(const Part& part, const Arm (&c)[2], double inverse, const Point& base, double overlap) {
    const double centre = (c[0].z * -eta(base.p) - (part.middle() - base.z) * eta(c[0].p)) * inverse;
    const double reach =
        (std::fabs(c[0].z) * part.width + 0.5 * (part.z_next - part.z) * std::fabs(eta(c[0].p))) *
            std::fabs(inverse) +
        kSlop3d;
    if (!(reach < kMaxLinesInPart && are_countable(centre - reach, centre + reach))) return false;
    for (double k = std::ceil(centre - reach); k <= centre + reach; ++k)
      if (!lines_.scan(base.step(k, c[1]), c[0], part.z - overlap, part.z_next + overlap)) return false;
    return true;
  }

  // Lagrange's reduction of two vectors of the plane; the shorter one is c_0, and points forward.
  bool reduce_in_plane(Arm (&c)[2], double along, double across) const {
    const auto times = [&](const Arm& a, const Arm& b) {
      return a.z * along * (b.z * along) + eta(a.p) * across * (eta(b.p) * across);
    };
    for (int step = 0; step < kMaxPlaneReductionSteps; ++step) {
      if (times(c[1], c[1]) < times(c[0], c[0])) std::swap(c[0], c[1]);
      const double k = std::nearbyint(times(c[0], c[1]) / times(c[0], c[0]));
      if (k == 0) {
        c[0].point_forward();
        return true;
      }
      c[1].subtract(k, c[0]);
      recompute<Arch>(window_.to, c[1], window_.basis->length);
    }
    return false;
  }

  const Window& window_;
  const Candidates& candidates_;
  Lines& lines_;
};

}  // namespace lorentz
