// The search for the first ball along a prepared direction, in 3D (direction_3d.hpp says how): window by
// window, each plane by plane. Private to the reduction engine.
#pragma once

#include <algorithm>

#include "src/engines/reduction/planes_3d.hpp"

namespace lorentz {

/// The search for one start.
template <class Arch, bool kUnit, bool kBall>
class Search3 {
  Window3<Arch, kUnit, kBall> window_;
  Candidates3<Arch, kUnit, kBall> candidates_;
  Lines3<Arch, kUnit, kBall> lines_;
  Planes3<Arch, kUnit, kBall> planes_;

 public:
  Search3(const Bravais& lattice, const Direction3<kUnit, kBall>& direction,
          const Offset<SplitProduct, 3>& offset)
      : window_(lattice, direction, offset),
        candidates_(window_),
        lines_(window_, candidates_),
        planes_(window_, candidates_, lines_),
        found(candidates_.found) {}
  Search3(const Search3&) = delete;
  Search3& operator=(const Search3&) = delete;

  Found<3>& found;

  /// `from`: coefficients of the ball that is being left, or null. Balls that are entered after s_limit may
  /// be ignored.
  Outcome run(const Wide* from, double s_limit) {
    candidates_.from = from;
    candidates_.s_limit = s_limit;
    window_.set_start();
    for (int window = 0; window < kMaxWindows; ++window) {
      if (!window_.basis->usable || !window_.set_anchor()) return give_up();
      planes_.none_met = true;
      if (!scan_window()) return give_up();
      if (found.any()) return Outcome::hit;
      advance();
      if (window_.begin > s_limit || window_.begin > 2 * period()) return Outcome::never;
      if (!(window_.begin < kFarthest)) return give_up();
      if (window >= 1) window_.lengthen(kLonger);
    }
    return give_up();
  }

 private:
  Outcome give_up() {
    found.stage = Stage::undecided;
    return Outcome::undecided;
  }

  // The planes k b_2 + (b_0, b_1) that meet the window.
  bool scan_window() {
    const Basis3& basis = *window_.basis;
    const double kappa = window_.plane_of(window_.anchor_point), tilt = basis.tilt();
    const double low = std::min(0.0, tilt) - basis.slope - kappa - kSlop3d,
                 high = std::max(0.0, tilt) + basis.slope - kappa + kSlop3d;
    if (!are_countable(low, high)) return false;
    for (double k = std::ceil(low); k <= high; ++k) {
      const Point3 point(window_.anchor_point, k, basis.b[2]);
      if (!planes_.scan(point, kappa + k)) return false;
    }
    return true;
  }

  // To the next window: right behind this one, or where the next lattice plane comes within r of the line.
  void advance() {
    const double step = planes_.none_met ? windows_to_next_plane() : 1;
    const double next = window_.begin + step * (1 - kSlop3d) * window_.basis->length;
    // Rounded down: no gap between the windows.
    window_.begin = std::max(window_.begin, next - kNextWindow * kRoundoff * next);
  }

  double windows_to_next_plane() const {
    const Basis3& basis = *window_.basis;
    const double tilt = basis.tilt(), kappa = window_.plane_of(window_.anchor_point);
    const double steepest = std::fabs(tilt) + basis.tilt_error;
    // Planes at k + kappa - tilt z = 0 on the line; how far the nearest one ahead has to come.
    const auto gap_above = [&](double here) { return std::ceil(here + basis.slope) - here - basis.slope; };
    const double up = gap_above(tilt - kappa), down = gap_above(kappa - tilt);
    // Of a tilt that is below its error not even the sign is known.
    const double gap = std::fabs(tilt) <= basis.tilt_error ? std::min(up, down) : tilt > 0 ? up : down;
    const double jump = 1 + (gap - kSlop3d) / steepest;
    return std::min(std::max(1.0, jump), kMaxJump);
  }

  // What lies on the line repeats after this: v . b of a lattice vector b that is exactly parallel to it.
  double period() const {
    for (const Arm3& arm : window_.basis->b)
      if (arm.p[0] == 0 && arm.p[1] == 0 &&
          is_parallel<SplitProduct, 3>(window_.lattice, window_.to.v, arm.n))
        return arm.z * window_.basis->length;
    return Found<3>::kNothing;
  }
};

}  // namespace lorentz
