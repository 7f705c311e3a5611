// One ball and the line, in double-double: along, across, and when it is entered. The second stage of every
// decision about a ball, and the time.
#pragma once

#include <cmath>

#include "bounds.hpp"
#include "double_double.hpp"
#include "predicates.hpp"
#include "problem.hpp"

namespace lorentz {

/// Seen from x: the centre at d, s = v . d, slack = r^2 v^2 - |v x d|^2, positive iff the line meets the open
/// ball.
template <class Arch, int D>
struct Encounter {
  using DD = DoubleDouble<Arch>;

  DD v2, s, slack;
  double s_error = 0, slack_error = 0;
  double nearness = 0;  ///< |d|

  /// d errs by at most `error` in each component.
  Encounter(const Vec& v, const DD (&d)[D], double error, double r) {
    v2 = DD::product(v[0], v[0]) + DD::product(v[1], v[1]);
    s = d[0] * v[0] + d[1] * v[1];
    const DD z = d[1] * v[0] - d[0] * v[1];
    DD h2 = z * z;
    double d2 = d[0].hi * d[0].hi + d[1].hi * d[1].hi;
    if constexpr (D == 3) {
      v2 = v2 + DD::product(v[2], v[2]);
      s = s + d[2] * v[2];
      const DD x = d[2] * v[1] - d[1] * v[2], y = d[0] * v[2] - d[2] * v[0];
      h2 = h2 + (x * x + y * y);
      d2 += d[2].hi * d[2].hi;
    }
    const DD rho2 = DD::product(r, r) * v2;
    slack = rho2 - h2;
    nearness = std::sqrt(d2);
    const double speed = std::sqrt(v2.hi), form_error = speed * (kStable * nearness + 2 * error) + kFlushed;
    s_error = form_error;
    slack_error = 2 * form_error * (std::sqrt(h2.hi) + form_error) + kStable * (rho2.hi + h2.hi);
  }

  Decision meets() const { return is_positive(slack.hi, slack_error); }
  Decision is_ahead() const { return is_positive(s.hi, s_error); }

  /// The time of entry, and the bound of its error. Required: the line meets the ball, which is ahead.
  DD time(const DD (&d)[D], double error, double r, double& time_error) const {
    double q_rounding = 0;
    DD q(std::sqrt(slack.hi));
    if (s.hi > 0x1p14 * q.hi)
      q_rounding = 2 * kRoundoff * q.hi;  // far away one roundoff of q does not count
    else
      q = sqrt(slack);
    // sqrt(slack + e) - sqrt(slack) is below e / sqrt(slack).
    const double q_error = slack_error / q.hi + kStable * q.hi + q_rounding;
    if (s.hi > 2 * q.hi) {
      // One of Newton's steps from a quotient within a few ulps.
      const DD difference = s - q;
      const double inverse = 1 / v2.hi, rough = difference.hi * inverse;
      const DD product = v2 * rough;
      const DD t =
          DD::ordered_sum(rough, ((difference.hi - product.hi) + (difference.lo - product.lo)) * inverse);
      time_error = 2 * (s_error + q_error) * inverse + 2 * kStable * t.hi;
      return t;
    }
    DD gap = -DD::product(r, r);
    for (const DD& component : d) gap = gap + component * component;
    const double gap_error = 8 * kStable * r * r + 8 * error * nearness;
    const DD t = gap / (s + q);
    time_error = 2 * (gap_error + t.hi * (s_error + q_error)) / (s.hi + q.hi) + 2 * kStable * t.hi;
    return t;
  }
};

}  // namespace lorentz
