// One obstacle and the line, in double-double: along, across, and when it is entered. The second stage of
// every decision about an obstacle, and the time.
#pragma once

#include <cmath>

#include <lorentz/vec.hpp>
#include "src/engines/base/double_double.hpp"
#include "src/engines/reduction/bounds.hpp"
#include "src/engines/reduction/bravais.hpp"
#include "src/engines/reduction/formulas.hpp"
#include "src/engines/reduction/predicates.hpp"

namespace lorentz {

/// |d|^2 in the shape's metric, and the bound of its error; d errs by at most `error` in each component.
template <class Arch, int D>
inline DoubleDouble<Arch> square_in(const Shape& shape, const DoubleDouble<Arch> (&d)[D], double error,
                                    double& square_error) {
  using DD = DoubleDouble<Arch>;
  DD image[D], square(0.0);
  apply_metric(shape, d, image);
  double size2 = 0;
  for (int k = 0; k < D; ++k) {
    square = square + image[k] * d[k];
    size2 += d[k].hi * d[k].hi;
  }
  square_error = (shape.metric_error + kStableForm * shape.metric_size) * size2 +
                 2 * kDiagonal * shape.metric_size * error * (std::sqrt(size2) + error);
  return square;
}

/// Seen from x: the centre at d, s = v . d, slack = r^2 v^2 - |v x d|^2, positive iff the line meets the open
/// ball. Of an ellipsoid: all of this in the metric of its shape (shape.hpp).
template <class Arch, int D, bool kBall>
struct StableMeeting {
  using DD = DoubleDouble<Arch>;

  DD v2, s, slack;
  double s_error = 0, slack_error = 0;
  double v2_error = 0;      ///< beyond the roundings of double-double
  double across_error = 0;  ///< of a component of v x d
  double nearness = 0;      ///< |d|

  /// d errs by at most `error` in each component.
  StableMeeting(const Vec& v, const DD (&d)[D], double error, const Bravais& lattice) {
    DD across[3];
    double d2 = d[0].hi * d[0].hi + d[1].hi * d[1].hi, speed2 = v[0] * v[0] + v[1] * v[1];
    across[2] = difference_of_products(d[1], v[0], d[0], v[1]);
    if constexpr (D == 3) {
      across[0] = difference_of_products(d[2], v[1], d[1], v[2]);
      across[1] = difference_of_products(d[0], v[2], d[2], v[0]);
      d2 += d[2].hi * d[2].hi, speed2 += v[2] * v[2];
    }
    nearness = std::sqrt(d2);
    const double speed = std::sqrt(speed2);
    across_error = speed * (kStable * nearness + kDiagonal * error) + kFlushed;
    DD h2;
    double h_error;
    if constexpr (kBall)
      measure_ball(v, d, across, h2, h_error);
    else
      measure_ellipsoid(lattice.shape, v, d, across, speed, error, h2, h_error);
    const DD rho2 = DD::product(lattice.radius, lattice.radius) * v2;
    slack = rho2 - h2;
    slack_error = 2 * h_error * (std::sqrt(h2.hi) + h_error) + kStable * (rho2.hi + h2.hi) +
                  lattice.radius * lattice.radius * v2_error;
  }

  Decision meets() const { return is_positive(slack.hi, slack_error); }
  Decision is_ahead() const { return is_positive(s.hi, s_error); }

  /// The time of entry, and the bound of its error. Required: the line meets the obstacle, which is ahead.
  DD time(const DD (&d)[D], double error, const Bravais& lattice, double& time_error) const {
    double q_rounding = 0;
    DD q(std::sqrt(slack.hi));
    if (s.hi > kFarSlack * q.hi)
      q_rounding = kRoot * kRoundoff * q.hi;  // far away one roundoff of q does not count
    else
      q = sqrt(slack);
    // sqrt(slack + e) - sqrt(slack) is below e / sqrt(slack).
    const double q_error = slack_error / q.hi + kStable * q.hi + q_rounding;
    if (s.hi > kNearWide * q.hi) {
      // One of Newton's steps from a quotient within a few ulps.
      const DD difference = s - q;
      const double inverse = 1 / v2.hi, rough = difference.hi * inverse;
      const DD product = v2 * rough;
      const DD t =
          DD::ordered_sum(rough, ((difference.hi - product.hi) + (difference.lo - product.lo)) * inverse);
      time_error = 2 * (s_error + q_error + t.hi * v2_error) * inverse + kStableTime * t.hi;
      return t;
    }
    double gap_error;
    const DD t = gap(d, error, lattice, gap_error) / (s + q);
    time_error = 2 * (gap_error + t.hi * (s_error + q_error)) / (s.hi + q.hi) + kStableTime * t.hi;
    return t;
  }

  /// |d|^2 - r^2, and the bound of its error.
  DD gap(const DD (&d)[D], double error, const Bravais& lattice, double& gap_error) const {
    const double r = lattice.radius;
    DD gap = -DD::product(r, r);
    if constexpr (kBall) {
      for (const DD& component : d) gap = gap + component * component;
      gap_error = kStableGap * r * r + 4 * kDiagonal * error * nearness;
    } else {
      const DD square = square_in(lattice.shape, d, error, gap_error);
      gap_error += kStableGap * (r * r + square.hi);
      gap = gap + square;
    }
    return gap;
  }

 private:
  void measure_ball(const Vec& v, const DD (&d)[D], const DD (&across)[3], DD& h2, double& h_error) {
    v2 = DD::product(v[0], v[0]) + DD::product(v[1], v[1]);
    h2 = across[2] * across[2];
    if constexpr (D == 2) {
      s = sum_of_products(d[0], v[0], d[1], v[1]);
    } else {
      v2 = v2 + DD::product(v[2], v[2]);
      s = sum_of_products(d[0], v[0], d[1], v[1], d[2], v[2]);
      h2 = h2 + (across[0] * across[0] + across[1] * across[1]);
    }
    s_error = h_error = across_error;
  }

  void measure_ellipsoid(const Shape& shape, const Vec& v, const DD (&d)[D], const DD (&across)[3],
                         double speed, double error, DD& h2, double& h_error) {
    Wide along[D];
    apply_metric<Arch>(shape, v, along);
    v2 = s = DD(0.0);
    for (int k = 0; k < D; ++k) {
      v2 = v2 + DD(along[k]) * v[k];
      s = s + DD(along[k]) * d[k];
    }
    const double form_error = shape.metric_error + kStableForm * shape.metric_size;
    v2_error = form_error * speed * speed;
    s_error = speed * (form_error * nearness + kDiagonal * shape.metric_size * error) + kFlushed;
    double size2 = 0;
    h2 = DD(0.0);
    for (int i = 3 - (D == 2 ? 1 : 3); i < 3; ++i) {
      DD h(0.0);
      for (int k = 3 - (D == 2 ? 1 : 3); k < 3; ++k) h = h + DD(shape.wide_cofactor[i][k]) * across[k];
      h2 = h2 + h * h;
      size2 += across[i].hi * across[i].hi;
    }
    h_error = 2 * shape.cofactor_size * across_error +
              (shape.cofactor_error + kStable * shape.cofactor_size) * std::sqrt(size2);
  }
};

}  // namespace lorentz
