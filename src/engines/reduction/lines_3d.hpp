// The balls along one lattice line that meet the flight, in 3D. Private to the reduction engine.
#pragma once

#include <algorithm>

#include "src/engines/reduction/candidates_3d.hpp"

namespace lorentz {

template <class Arch, bool kUnit, bool kBall, class Integer>
class Lines3 {
  using Window = Window3<Arch, kUnit, kBall, Integer>;
  using Candidates = Candidates3<Arch, kUnit, kBall, Integer>;
  using Point = typename Window::Point;
  using Arm = typename Window::Arm;
  using Look = typename Candidates::Look;

 public:
  Lines3(const Window& window, Candidates& candidates) : window_(window), candidates_(candidates) {}

  /// Scans the line through q with steps `arm`. False: undecided. `moves`: how often q may be moved along.
  bool scan(const Point& q, const Arm& arm, double z_first, double z_last) {
    LineOf3<SplitProduct, Integer> line;
    if (!line.set(q, arm, window_.line_error(q))) return true;
    line.set_ends();
    if (!(line.slack < kMaxUnsure)) return scan_closely(q, arm, z_first, z_last, line.first);
    line.cut(q, arm, z_first, z_last);
    if constexpr (std::is_same_v<Integer, Wide>)
      if (line.first <= line.last && moves_ > 0 && std::fabs(line.first) >= kMaxCoefficient)
        return scan_from_there(q, arm, z_first, z_last, line.first);
    return scan_stretch(q, arm, std::ceil(line.first), line.last);
  }

 private:
  // A stretch that begins beyond the integers of binary64 is seen from a point near it.
  [[gnu::noinline]] bool scan_from_there(const Point& q, const Arm& arm, double z_first, double z_last,
                                         double first) {
    --moves_;
    const bool done = scan(window_.recomputed(q.step(std::nearbyint(first), arm)), arm, z_first, z_last);
    ++moves_;
    return done;
  }

  // Scans a line nearly parallel to the flight, for which binary64 cannot tell at which k it enters the
  // cylinder. `estimate` is near that k.
  [[gnu::noinline]] bool scan_closely(const Point& q, const Arm& arm, double z_first, double z_last,
                                      double estimate) {
    if (!(arm.z > 0)) return false;
    const double k_first = std::ceil((z_first - q.z) / arm.z - kSlop3d),
                 k_last = (z_last - q.z) / arm.z + kSlop3d;
    const Point first = q.step(k_first, arm);
    const double drift = (std::fabs(arm.p[0]) + std::fabs(arm.p[1])) * (k_last - k_first);
    const double distance = std::sqrt(first.p[0] * first.p[0] + first.p[1] * first.p[1]);
    const double unsure = kDiscriminant * window_.line_error(first);
    if (distance - drift > 1 + unsure || has_passed(first, arm, k_last - k_first, distance)) return true;
    const bool is_near = distance < 1 - unsure, is_parallel = !is_near && window_.is_parallel(arm);
    if (is_parallel && candidates_.is_missed(first)) return true;  // and so is every ball of the line
    if (is_near || is_parallel || k_last - k_first < kShortStretch || !(estimate > k_first))
      return scan_stretch(window_.recomputed(first), arm, 0, k_last - k_first);
    Point entry = window_.recomputed(q.step(std::nearbyint(estimate), arm));
    double k;
    if (!refine_entry(arm, entry, k)) return false;
    k = std::max(k, std::ceil((z_first - entry.z) / arm.z - kSlop3d));
    return scan_stretch(window_.recomputed(entry.step(k, arm)), arm, 0,
                        (z_last - entry.z) / arm.z + kSlop3d - k);
  }

  // Is the point at this distance outside of the cylinder, and the line on its way out of it? Then none of its next
  // balls is met.
  bool has_passed(const Point& point, const Arm& arm, double steps, double distance) const {
    const double x = point.p[0] * arm.p[0], y = point.p[1] * arm.p[1];
    return x + y > kAmple * (std::fabs(x) + std::fabs(y)) &&
           distance > 1 + kDiscriminant * window_.line_error(point.step(steps, arm));
  }

  // Moves a point of the line to near its entry into the cylinder, by steps in double-double, and sets k so
  // that k steps on is just before it.
  bool refine_entry(const Arm& arm, Point& there, double& k) {
    candidates_.found.needs(Stage::double_double);
    const double rho2 = window_.to.rho * window_.to.rho, speed = std::fabs(arm.p[0]) + std::fabs(arm.p[1]);
    for (int pass = 0; pass < kMaxEntryPasses; ++pass) {
      Wide N[3];
      if (!window_.cell_of(there, N)) return false;
      const double inward = -2 * (there.p[0] * arm.p[0] + there.p[1] * arm.p[1]);
      double slack, slack_error;
      candidates_.set_slack(N, slack, slack_error);
      const double outside = -slack / rho2, step = outside / inward;  // |p|^2 - 1
      if (inward > 0 && std::fabs(step) * speed * speed < kEntryCurvature * inward) {
        const double unsure =
            kEntrySlop + std::fabs(step) * (2 * kEntryCurvature) + slack_error / rho2 / inward;
        k = std::floor(step - unsure);
        if (unsure < kMaxEntryError) return true;
      }
      // To the first root of outside - inward k + |p|^2 k^2.
      const double a = square_of(arm.p), root = std::sqrt(inward * inward - 4 * a * outside);
      const double first = inward > 0 ? 2 * outside / (inward + root) : (inward - root) / (2 * a);
      if (!(std::fabs(first) < kMaxAnchorStep)) return false;  // also where there is no root
      there = window_.recomputed(there.step(std::nearbyint(first), arm));
    }
    return false;
  }

  bool scan_stretch(const Point& q, const Arm& arm, double k_first, double k_last) {
    k_last = std::min(k_last, k_first + kMaxCandidatesOnLine + 1);
    if (k_first <= k_last && !are_countable(k_first, k_last)) return false;
    int steps = 0;
    for (double k = k_first; k <= k_last; ++k) {
      if (++steps > kMaxCandidatesOnLine) return false;
      const Look look = candidates_.look_at(q.step(k, arm));
      if (look == Look::doubtful) return false;
      if (look != Look::missed) return true;
    }
    return true;
  }

  const Window& window_;
  Candidates& candidates_;
  int moves_ = kMaxEntryPasses;  // along a line that are left
};

}  // namespace lorentz
