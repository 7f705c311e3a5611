// A single ball on the line of flight.

/// A ball with its centre at d relative to x: s = v . d and slack = (r |v|)^2 - |v x d|^2, in binary64. The
/// earliest entry is at s - s_rho.
template <class Numbers, int D>
struct LoneBall {
  using Number = typename Numbers::Number;
  using Mask = typename Numbers::Mask;

  Number s, s_error, slack, slack_error;

  /// d errs by at most `error` in each component, besides the roundoff of its high part; v2 = |v|^2.
  LORENTZ_INLINE LoneBall(const Number (&v)[D], const DoubleDouble<Numbers> (&d)[D], Number error, Number v2,
                          double radius) {
    Number place[D], h[D == 2 ? 1 : 3];
    for (int k = 0; k < D; ++k) place[k] = d[k].hi;
    cross_of(v, place, h);
    s = product_of(v, place);
    const Number h2 = square_of(h), rho2 = squared_width_of(all(radius), v2);
    const Number product = root_above(v2 * square_of(place)), of_d = 4 * kDiagonal * error + all(kFlushed);
    const Number h_error = kLoneAcross * kRoundoff * product + of_d;
    s_error = kLoneAlong * kRoundoff * product + of_d;
    slack = rho2 - h2;
    slack_error = 2 * h_error * (root_above(h2) + 2 * h_error) + kLoneSlack * kRoundoff * (rho2 + h2);
  }

  LORENTZ_INLINE Mask is_met() const { return slack > slack_error; }
  LORENTZ_INLINE Mask is_missed() const { return slack < Neg(slack_error); }
  LORENTZ_INLINE Mask is_ahead() const { return s > s_error; }
  LORENTZ_INLINE Mask is_behind() const { return s < Neg(s_error); }
};
