#include "oracle/exact/planes.hpp"

namespace lorentz::oracle {

Planes::Planes(const ExactVelocity<3>& velocity, const Z& rho2, const LatticePoint<3>& b1,
               const LatticePoint<3>& b2, const LatticePoint<3>& b3)
    : velocity(velocity), next(b3) {
  normal = cross(b1.p, b2.p);
  a = dot(normal, velocity.v);
  gap = dot(normal, b3.p);
  e = cross(velocity.v, normal);
  reach2 = rho2 * dot(e, e);
  reach = floor_sqrt(reach2);
  head_on = reach2 == 0;
  across2 = reach2;
  across = reach;
  if (head_on) {
    e = b1.p;
    f = cross(velocity.v, e);
    across2 = rho2 * dot(e, e);
    across = floor_sqrt(across2);
  }
}

Range Planes::levels(const LatticePoint<3>& offset, const Z& low, const Z& high) const {
  const Z home = velocity.v2 * dot(normal, offset.p);
  const auto [least, most] = ordered(a * low, a * high);
  return multiples_between(least - reach - home, most + reach - home, gap * velocity.v2);
}

PlanePoint Planes::in_plane(const LatticePoint<3>& b) const {
  return {b, dot(e, b.p), head_on ? dot(f, b.p) : dot(velocity.v, b.p)};
}

PlaneSection Planes::section(const LatticePoint<3>& offset, const Z& k3, const Z& low, const Z& high) const {
  PlaneSection section;
  section.origin = offset;
  section.origin.add_multiple(k3, next);
  const Z level = velocity.v2 * dot(normal, section.origin.p);
  section.low = low;
  section.high = high;
  // The part of the flight where |a s - level| <= reach, and the half-width of the section there: `room` is
  // the largest rho^2 |e|^2 - (a s - level)^2.
  Z room = across2;
  section.z_low = -across;
  section.z_high = across;
  if (a != 0) {
    const Range s = multiples_between(level - reach, level + reach, a);
    section.low = std::max(low, s.first);
    section.high = std::min(high, s.last);
    if (section.low > section.high) return section;
  }
  if (!head_on) {
    section.z_low = section.low;
    section.z_high = section.high;
    const Z at_low = a * section.low - level, at_high = a * section.high - level;
    if (sgn(at_low) * sgn(at_high) > 0) {
      const Z nearest = std::min(abs(at_low), abs(at_high));
      room -= nearest * nearest;
    }
  }
  if (room <= 0) return section;
  section.half_width = floor_sqrt(floor_div(room, velocity.v2));
  section.empty = false;
  return section;
}

// A point at (y, z) is in row k2 = (y1 (z - z0) - z1 (y - y0)) / (y1 z2 - z1 y2).
Range Planes::rows(const PlaneSection& section, const PlanePoint& g1, const PlanePoint& g2) const {
  const PlanePoint start = in_plane(section.origin);
  const auto [least, most] = ordered(g1.y * section.z_low, g1.y * section.z_high);
  const Z spread = abs(g1.z) * section.half_width;
  const Z home = g1.y * start.z - g1.z * start.y;
  return multiples_between(least - spread - home, most + spread - home, g1.y * g2.z - g1.z * g2.y);
}

}  // namespace lorentz::oracle
