// A stretch of the flight in 3D, and the lattice point near its middle from which all others are counted, in
// small numbers. Private to the reduction engine.
#pragma once

#include <algorithm>

#include "src/engines/reduction/direction_3d.hpp"

namespace lorentz {

/// A lattice point relative to the anchor; `size` and `extent`: of the terms that p and z were summed from.
struct Point3 {
  double n[3], p[2], z, size, extent;

  Point3() = default;
  Point3(const Point3& base, double k, const Arm3& arm) {
    for (int i = 0; i < 3; ++i) n[i] = base.n[i] + k * arm.n[i];
    const double step[2] = {k * arm.p[0], k * arm.p[1]};
    for (int i = 0; i < 2; ++i) p[i] = stepped(base.p[i], k, arm.p[i]);
    z = stepped(base.z, k, arm.z);
    size = base.size + std::fabs(step[0]) + std::fabs(step[1]) + std::fabs(k) * arm.cancellation;
    extent = base.extent + std::fabs(k * arm.z);
  }
};

/// Can one count from low to high by ones?
inline bool are_countable(double low, double high) {
  return std::fabs(low) < kMaxCoefficient && std::fabs(high) < kMaxCoefficient;
}

template <class Arch, bool kUnit, bool kBall>
class Window3 {
  using DD = DoubleDouble<Arch>;
  using Direction = Direction3<kUnit, kBall>;

 public:
  const Bravais& lattice;
  const Direction& to;
  const Offset<SplitProduct, 3>& offset;
  const Basis3* basis;
  double begin = 0;  ///< in units of s
  Wide anchor[3];    ///< from the home cell, in the short basis
  Point3 anchor_point;
  double p_error = 0, s_error = 0, z_error = 0;  ///< of the anchor
  double z_first = 0;                            ///< where the window begins, with its error

  Window3(const Bravais& of_lattice, const Direction& direction, const Offset<SplitProduct, 3>& from_offset)
      : lattice(of_lattice), to(direction), offset(from_offset), basis(&direction.basis) {}

  void set_start() {
    to.template forms_of<Arch>(offset.d, start_);
    for (const Wide& component : offset.d) start_size_ += std::fabs(component.hi);
  }

  /// False if none is found that is known well enough.
  bool set_anchor() {
    if (!find_anchor()) return false;
    double terms = start_size_;
    for (int j = 0; j < 3; ++j) {
      if (!(std::fabs(anchor[j].hi) < kMaxCell)) return false;
      terms += std::fabs(anchor[j].hi) * to.size_of[j];
    }
    const double error = kForm * (kAnchorTerms * terms + offset.error) + kFlushed;
    p_error = error * to.inverse_r;
    s_error = to.along_size * error + kRoundoff * begin;
    if constexpr (!kBall) s_error += kForm * lattice.shape.metric_error * terms;
    z_error = s_error / basis->length;
    z_first = -(2 * z_error + kWindowStart);
    return p_error < kSlop3d / 2;
  }

  /// The window from here on, by a basis that suits its length.
  void lengthen(double factor) {
    if (basis != &longer_) longer_ = *basis;
    to.template lengthen<Arch>(longer_, factor, true);
    basis = &longer_;
  }

  /// The same point, its coordinates from the integers.
  Point3 recomputed(const Point3& point) const {
    Wide N[3];
    for (int i = 0; i < 3; ++i) N[i] = anchor[i] + Wide(point.n[i]);
    Point3 same = at(N);
    for (int i = 0; i < 3; ++i) same.n[i] = point.n[i];
    return same;
  }

  /// The point's coefficients from the home cell; false if they are not exact.
  bool cell_of(const Point3& point, Wide (&N)[3]) const {
    for (int i = 0; i < 3; ++i) {
      if (!(std::fabs(point.n[i]) < kMaxCoefficient)) return false;
      N[i] = anchor[i] + Wide(point.n[i]);
    }
    return true;
  }

  /// Which lattice plane, parallel to the first two vectors of the basis, the point is on.
  double plane_of(const Point3& point) const {
    const auto& g = basis->dual[2];
    return sum_of_products(g[0], point.p[0], g[1], point.p[1], g[2], point.z);
  }

  double scale_error() const {
    if constexpr (kBall) return kScale * kRoundoff;
    return to.scale_error;
  }

 private:
  // Near the middle of the window, in few steps from the home cell.
  bool find_anchor() {
    for (Wide& n : anchor) n = Wide();
    for (int i = 0; i < 2; ++i) anchor_point.p[i] = to.scale[i] * start_[i].hi;
    anchor_point.z = (start_[2].hi - begin) / basis->length;
    for (int pass = 0; pass < kMaxAnchorPasses; ++pass) {
      double k[3], largest = 0;
      for (int i = 0; i < 3; ++i) {
        const auto& g = basis->dual[i];
        k[i] = -std::nearbyint(sum_of_products(g[0], anchor_point.p[0], g[1], anchor_point.p[1], g[2],
                                               anchor_point.z - kMiddle));
        largest = std::max(largest, std::fabs(k[i]));
      }
      if (!(largest < kMaxAnchorStep)) return false;
      move_anchor(k);
      anchor_point = at(anchor);
      if (largest < kNearAnchor) return true;
    }
    return false;
  }

  // By integers, exactly if they are below 2^53; beyond, whatever the rounding makes of them is a lattice
  // point too.
  void move_anchor(const double (&k)[3]) {
    for (int j = 0; j < 3; ++j) {
      double sum = anchor[j].hi, size = std::fabs(sum);
      for (int i = 0; i < 3; ++i) {
        const double step = k[i] * basis->b[i].n[j];
        sum += step, size += std::fabs(step);
      }
      if (size < kMaxCoefficient && anchor[j].lo == 0) {
        anchor[j] = Wide(sum);
        continue;
      }
      for (int i = 0; i < 3; ++i) anchor[j] = anchor[j] + Wide::product(k[i], basis->b[i].n[j]);
    }
  }

  Point3 at(const Wide (&N)[3]) const {
    const auto& form = to.form();
    const Wide from = begin == 0 ? start_[2] : start_[2] - Wide(begin);
    Point3 point;
    for (double& n : point.n) n = 0;
    if (N[0].lo == 0 && N[1].lo == 0 && N[2].lo == 0) {  // nearly always; to the same bits
      const double n[3] = {N[0].hi, N[1].hi, N[2].hi};
      point.p[0] = to.scale[0] * compensated_sum_from<DD, Direction::kFirstTerms>(start_[0], form[0], n);
      point.p[1] = to.scale[1] * compensated_sum_from<DD>(start_[1], form[1], n);
      point.z = compensated_sum_from<DD, 3, Direction::kLowParts>(from, form[2], n) / basis->length;
    } else {
      for (int i = 0; i < 2; ++i) point.p[i] = to.scale[i] * compensated_sum<DD>(form[i], N, start_[i]);
      point.z = compensated_sum<DD>(form[2], N, from) / basis->length;
    }
    point.size = std::fabs(point.p[0]) + std::fabs(point.p[1]);
    point.extent = std::fabs(point.z);
    return point;
  }

  Basis3 longer_;
  Wide start_[3];
  double start_size_ = 0;
};

}  // namespace lorentz
