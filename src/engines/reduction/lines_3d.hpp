// The balls along one lattice line that meet the flight, in 3D. Private to the reduction engine.
#pragma once

#include <algorithm>

#include "src/engines/reduction/candidates_3d.hpp"

namespace lorentz {

template <class Arch, bool kUnit, bool kBall>
class Lines3 {
  using Window = Window3<Arch, kUnit, kBall>;
  using Candidates = Candidates3<Arch, kUnit, kBall>;
  using Look = typename Candidates::Look;

 public:
  Lines3(const Window& window, Candidates& candidates) : window_(window), candidates_(candidates) {}

  /// Scans the line through q with steps `arm`. False: undecided.
  bool scan(const Point3& q, const Arm3& arm, double z_first, double z_last) {
    LineOf3<SplitProduct> line;
    if (!line.set(q, arm, window_.line_error(q))) return true;
    line.set_ends();
    if (!(line.slack < kMaxUnsure)) return scan_closely(q, arm, z_first, z_last, line.first);
    line.cut(q, arm, z_first, z_last);
    return scan_stretch(q, arm, std::ceil(line.first), line.last);
  }

 private:
  // Scans a line nearly parallel to the flight, for which binary64 cannot tell at which k it enters the
  // cylinder. `estimate` is near that k.
  [[gnu::noinline]] bool scan_closely(const Point3& q, const Arm3& arm, double z_first, double z_last,
                                      double estimate) {
    if (!(arm.z > 0)) return false;
    const double k_first = std::ceil((z_first - q.z) / arm.z - kSlop3d),
                 k_last = (z_last - q.z) / arm.z + kSlop3d;
    const Point3 first = q.step(k_first, arm);
    const double drift = (std::fabs(arm.p[0]) + std::fabs(arm.p[1])) * (k_last - k_first);
    const double distance = std::sqrt(first.p[0] * first.p[0] + first.p[1] * first.p[1]);
    const double unsure = kDiscriminant * window_.line_error(first);
    if (distance - drift > 1 + unsure) return true;
    if (distance < 1 - unsure || k_last - k_first < kShortStretch || !(estimate > k_first))
      return scan_stretch(q, arm, k_first, k_last);
    double k = std::nearbyint(estimate);
    return refine_entry(q, arm, k) && scan_stretch(q, arm, std::max(k_first, k), k_last);
  }

  // Moves k from near the entry of a line into the cylinder to just before it, by a Newton step in
  // double-double.
  bool refine_entry(const Point3& q, const Arm3& arm, double& k) {
    const Point3 there = q.step(k, arm);
    Wide N[3];
    if (!window_.cell_of(there, N)) return false;
    candidates_.found.needs(Stage::double_double);
    const auto meeting = candidates_.meeting_at(N);
    const double rho2 = window_.to.rho * window_.to.rho, outside = -meeting.slack.hi / rho2;  // |p|^2 - 1
    const double inward = -2 * (there.p[0] * arm.p[0] + there.p[1] * arm.p[1]);
    const double speed = std::fabs(arm.p[0]) + std::fabs(arm.p[1]), step = outside / inward;
    if (!(inward > 0 && std::fabs(step) * speed * speed < kEntryCurvature * inward))
      return false;  // grazing, or not near
    const double unsure =
        kEntrySlop + std::fabs(step) * (2 * kEntryCurvature) + meeting.slack_error / rho2 / inward;
    if (!(unsure < kMaxEntryError)) return false;
    k = std::floor(k + step - unsure);
    return true;
  }

  bool scan_stretch(const Point3& q, const Arm3& arm, double k_first, double k_last) {
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
};

}  // namespace lorentz
