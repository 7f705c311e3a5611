// One line and one obstacle: where the line enters the obstacle, and how the velocity is reflected there.
// Private to src/trajectory.
#pragma once

#include "src/trajectory/real.hpp"

namespace lorentz {

/// An obstacle relative to its centre: a ball, or the ellipsoid { A y : |y| < 1 }, whose frame is y.
template <class Real>
struct MeetingShape {
  bool ball = true;
  Real radius = 0;                  ///< of the ball, or 1 in the ellipsoid's frame
  std::array<Point<Real>, 3> axes;  ///< for an ellipsoid: the columns of A,
  std::array<Point<Real>, 3> dual;  ///< and the rows of A^-1
  double inverse_size = 1;          ///< an upper bound on |A^-1|; 1 for a ball
};

template <class Real>
struct LineMeeting {
  Real time;                ///< from now
  Point<Real> offset;       ///< from the centre, on the surface
  Point<Real> velocity;     ///< after the reflection, not yet rescaled to the initial speed
  Point<Real> normal;       ///< outward, of any length
  bool on_the_line = true;  ///< false: beyond all rounding, the obstacle is not ahead on the line
};

/// Where the line w + t u enters the sphere of radius `radius` around 0. The moment w x u gives, without
/// cancellation, the point p of the line that is nearest to 0. From there sqrt(radius^2 - p^2) leads to the
/// sphere, so the point of entry is on it by construction, however long the flight. A line that misses the
/// sphere by less than `slack` counts as grazing it.
template <class Real>
struct MeetingEntry {
  Real time;
  Point<Real> point;
  Real root;  ///< - u . point
  bool there;

  MeetingEntry(const Point<Real>& w, const Point<Real>& u, Real radius, double slack) {
    using std::sqrt;
    const Real u2 = inner(u, u), inverse = Real(1) / u2;
    const Point<Real> p = times(inverse, outer(u, outer(w, u)));
    const Real p2 = inner(p, p), square = radius * radius - p2;
    const bool grazes = !(high_part(square) > 0);
    root = grazes ? Real(0) : sqrt(square * u2);
    point = grazes ? times(radius / sqrt(p2), p) : plus(p, -(root * inverse), u);
    time = -((inner(w, u) + root) * inverse);
    const double reach = high_part(radius) + slack, way = high_part(time) * high_part(time) * high_part(u2);
    there = high_part(p2) <= reach * reach && way < HUGE_VAL && (high_part(time) > 0 || way <= slack * slack);
  }
};

/// The line is w + t v relative to the obstacle's centre, and may be off by `slack`.
template <class Real>
LineMeeting<Real> meeting_of(const MeetingShape<Real>& shape, const Point<Real>& w, const Point<Real>& v,
                             double slack) {
  const auto in_frame = [&](const Point<Real>& a) {
    return shape.ball
               ? a
               : Point<Real>{inner(shape.dual[0], a), inner(shape.dual[1], a), inner(shape.dual[2], a)};
  };
  const MeetingEntry<Real> entry(in_frame(w), in_frame(v), shape.radius, slack * shape.inverse_size);
  const Point<Real>& y = entry.point;
  LineMeeting<Real> meeting;
  meeting.time = entry.time;
  meeting.on_the_line = entry.there;
  meeting.offset = meeting.normal = y;
  Real square = shape.radius * shape.radius;
  if (!shape.ball) {
    meeting.offset = plus(plus(times(y[0], shape.axes[0]), y[1], shape.axes[1]), y[2], shape.axes[2]);
    meeting.normal = plus(plus(times(y[0], shape.dual[0]), y[1], shape.dual[1]), y[2], shape.dual[2]);
    square = inner(meeting.normal, meeting.normal);
  }
  meeting.velocity = plus(v, (entry.root + entry.root) / square, meeting.normal);
  return meeting;
}

}  // namespace lorentz
