// One obstacle and the line, in double-double: along, across, and the time of entry. This is the second stage
// of every decision about an obstacle, and gives the time.

/// G a, by rows.
template <class Arch, int D>
LORENTZ_INLINE void apply_metric(const Shape& shape, const DoubleDouble<Arch> (&a)[D],
                                 DoubleDouble<Arch> (&image)[D]) {
  using DD = DoubleDouble<Arch>;
  for (int i = 0; i < D; ++i) {
    image[i] = DD(shape.metric[i][0]) * a[0];
    for (int k = 1; k < D; ++k) image[i] = image[i] + DD(shape.metric[i][k]) * a[k];
  }
}

/// The same for a binary64 vector, in fewer operations.
template <class Arch, int D, class Vector>
LORENTZ_INLINE void apply_metric(const Shape& shape, const Vector& a, DoubleDouble<Arch> (&image)[D]) {
  using DD = DoubleDouble<Arch>;
  for (int i = 0; i < D; ++i) {
    image[i] = DD(all(0));
    for (int k = 0; k < D; ++k) image[i] = add_product(image[i], DD(shape.metric[i][k]), a[k]);
  }
}

/// |d|^2 in the shape's metric, and a bound on its error; d errs by at most `error` in each component.
template <class Arch, int D>
LORENTZ_INLINE DoubleDouble<Arch> square_in(const Shape& shape, const DoubleDouble<Arch> (&d)[D],
                                            typename Arch::Number error,
                                            typename Arch::Number& square_error) {
  using DD = DoubleDouble<Arch>;
  DD image[D], square(all(0));
  apply_metric(shape, d, image);
  typename Arch::Number size2 = all(0);
  for (int k = 0; k < D; ++k) {
    square = square + image[k] * d[k];
    size2 = size2 + d[k].hi * d[k].hi;
  }
  square_error = (shape.metric_error + kStableForm * shape.metric_size) * size2 +
                 2 * kDiagonal * shape.metric_size * error * (sqrt(size2) + error);
  return square;
}

/// An obstacle with its centre at d relative to x: s = v . d, and slack = r^2 v^2 - |v x d|^2, which is
/// positive iff the line meets the open ball. For an ellipsoid all of this is in the metric of its shape
/// (shape.hpp).
template <class Arch, int D, bool kBall>
struct StableMeeting {
  using DD = DoubleDouble<Arch>;
  using Number = typename Arch::Number;
  using Mask = typename Arch::Mask;

  DD v2, s, slack;
  Number s_error, slack_error;
  Number v2_error;      ///< beyond the roundings of double-double
  Number across_error;  ///< of a component of v x d
  Number nearness;      ///< |d|

  /// d errs by at most `error` in each component.
  template <class Vector>
  LORENTZ_INLINE StableMeeting(const Vector& v, const DD (&d)[D], Number error, const Bravais& lattice) {
    DD across[3];
    Number d2 = d[0].hi * d[0].hi + d[1].hi * d[1].hi, speed2 = v[0] * v[0] + v[1] * v[1];
    across[2] = difference_of_products(d[1], v[0], d[0], v[1]);
    if constexpr (D == 3) {
      across[0] = difference_of_products(d[2], v[1], d[1], v[2]);
      across[1] = difference_of_products(d[0], v[2], d[2], v[0]);
      d2 = d2 + d[2].hi * d[2].hi, speed2 = speed2 + v[2] * v[2];
    }
    nearness = sqrt(d2);
    const Number speed = sqrt(speed2);
    across_error = speed * (kStable * nearness + kDiagonal * error) + all(kFlushed);
    v2_error = all(0);
    DD h2;
    Number h_error;
    if constexpr (kBall)
      measure_ball(v, d, across, h2, h_error);
    else
      measure_ellipsoid(lattice.shape, v, d, across, speed, error, h2, h_error);
    const Number r = all(lattice.radius);
    const DD rho2 = DD::product(r, r) * v2;
    slack = rho2 - h2;
    slack_error = 2 * h_error * (sqrt(h2.hi) + h_error) + kStable * (rho2.hi + h2.hi) + r * r * v2_error;
  }

  /// The time of entry, and a bound on its error. Requires that the line meets the obstacle, and that it is
  /// ahead.
  LORENTZ_INLINE DD time(const DD (&d)[D], Number error, const Bravais& lattice, Number& time_error) const {
    DD q(sqrt(slack.hi));
    const Mask root_is_far = s.hi > kFarSlack * q.hi;  // where one roundoff of q does not count
    const Number q_rounding = where(root_is_far, kRoot * kRoundoff * q.hi);
    if (any(Not(root_is_far))) q = select(root_is_far, q, sqrt(slack));
    // sqrt(slack + e) - sqrt(slack) is below e / sqrt(slack).
    const Number q_error = slack_error / q.hi + kStable * q.hi + q_rounding;
    const Mask far = s.hi > kNearWide * q.hi;
    if (nowhere(far)) return near_time(d, error, lattice, q, q_error, time_error);
    DD t = far_time(q, q_error, time_error);
    if (any(Not(far))) {
      Number near_error;
      t = select(far, t, near_time(d, error, lattice, q, q_error, near_error));
      time_error = select(far, time_error, near_error);
    }
    return t;
  }

  /// |d|^2 - r^2, and a bound on its error.
  LORENTZ_INLINE DD gap(const DD (&d)[D], Number error, const Bravais& lattice, Number& gap_error) const {
    const double r = lattice.radius;
    DD gap = -DD::product(all(r), all(r));
    if constexpr (kBall) {
      for (const DD& component : d) gap = gap + component * component;
      gap_error = all(kStableGap * r * r) + 4 * kDiagonal * error * nearness;
    } else {
      const DD square = square_in(lattice.shape, d, error, gap_error);
      gap_error = gap_error + kStableGap * (all(r * r) + square.hi);
      gap = gap + square;
    }
    return gap;
  }

 private:
  // (s - q) / v^2, by one Newton step from a quotient that is right within a few ulps.
  LORENTZ_INLINE DD far_time(const DD& q, Number q_error, Number& time_error) const {
    const DD difference = s - q;
    const Number inverse = 1 / v2.hi, rough = difference.hi * inverse;
    const DD product = v2 * rough;
    const DD t =
        DD::ordered_sum(rough, ((difference.hi - product.hi) + (difference.lo - product.lo)) * inverse);
    time_error = 2 * (s_error + q_error + t.hi * v2_error) * inverse + kStableTime * t.hi;
    return t;
  }

  // (|d|^2 - r^2) / (s + q), where the difference would cancel.
  LORENTZ_INLINE DD near_time(const DD (&d)[D], Number error, const Bravais& lattice, const DD& q,
                              Number q_error, Number& time_error) const {
    Number gap_error;
    const DD t = gap(d, error, lattice, gap_error) / (s + q);
    time_error = 2 * (gap_error + t.hi * (s_error + q_error)) / (s.hi + q.hi) + kStableTime * t.hi;
    return t;
  }

  template <class Vector>
  LORENTZ_INLINE void measure_ball(const Vector& v, const DD (&d)[D], const DD (&across)[3], DD& h2,
                                   Number& h_error) {
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

  template <class Vector>
  LORENTZ_INLINE void measure_ellipsoid(const Shape& shape, const Vector& v, const DD (&d)[D],
                                        const DD (&across)[3], Number speed, Number error, DD& h2,
                                        Number& h_error) {
    DD along[D];
    apply_metric(shape, v, along);
    v2 = s = DD(all(0));
    for (int k = 0; k < D; ++k) {
      v2 = v2 + along[k] * v[k];
      s = s + along[k] * d[k];
    }
    const double form_error = shape.metric_error + kStableForm * shape.metric_size;
    v2_error = form_error * speed * speed;
    s_error = speed * (form_error * nearness + kDiagonal * shape.metric_size * error) + all(kFlushed);
    Number size2 = all(0);
    h2 = DD(all(0));
    for (int i = D == 2 ? 2 : 0; i < 3; ++i) {
      DD h(all(0));
      for (int k = D == 2 ? 2 : 0; k < 3; ++k) h = h + DD(shape.wide_cofactor[i][k]) * across[k];
      h2 = h2 + h * h;
      size2 = size2 + across[i].hi * across[i].hi;
    }
    h_error = 2 * shape.cofactor_size * across_error +
              (shape.cofactor_error + kStable * shape.cofactor_size) * sqrt(size2);
  }
};

/// The decisions that a meeting makes certain. s and the slack are in binary64, with errors that include this
/// rounding.
template <class Arch>
struct CloseLook {
  typename Arch::Number s, s_error, slack, slack_error;
  typename Arch::Mask is_missed, is_met, is_behind, is_ahead;

  template <class Meeting>
  LORENTZ_INLINE explicit CloseLook(const Meeting& meeting)
      : s(meeting.s.hi),
        s_error(meeting.s_error + kRoundoff * s),
        slack(meeting.slack.hi),
        slack_error(meeting.slack_error + kRoundoff * slack),
        is_missed(slack < Neg(meeting.slack_error)),
        is_met(slack > meeting.slack_error),
        is_behind(s < Neg(meeting.s_error)),
        is_ahead(s > meeting.s_error) {}
};
