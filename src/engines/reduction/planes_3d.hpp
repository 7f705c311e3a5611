// The lines of one lattice plane that meet the flight's cylinder, in 3D. Private to the reduction engine.
#pragma once

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

  /// Scans the plane of this point. False: undecided.
  bool scan(const Point3& point, double kappa) {
    typename Window::Section section;
    if (!window_.set_section(point, kappa, candidates_.end(), section)) return true;
    none_met = false;
    const double low = section.low, high = section.high, z_first = section.z_first, z_last = section.z_last;
    if (!are_countable(low, high)) return false;
    if (high - low > kManyLines)
      return ThinSection3<Arch, kUnit, kBall>(window_, candidates_, lines_)
          .scan(point, z_first, z_last, kappa, section.xi_error);
    const Basis3& basis = *window_.basis;
    for (double k = low; k <= high; ++k)
      if (!lines_.scan(point.step(k, basis.b[1]), basis.b[0], z_first, z_last)) return false;
    return true;
  }

 private:
  const Window& window_;
  const Candidates& candidates_;
  Lines& lines_;
};

}  // namespace lorentz
