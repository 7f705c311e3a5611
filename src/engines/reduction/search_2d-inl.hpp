// The rows of a 2D lattice along a prepared direction, as a start sees them.

/// Heights and positions are counted from the ball of the home cell. Among tiny balls they are counted from
/// the lattice point nearest to the start in the coordinates of R and L: those of the home cell are so large
/// that their products are not exact, and that they multiply the errors of D_R and D_L.
template <class Arch, class Numbers, bool kUnit, bool kBall>
class RowsOf2 {
 protected:
  using DD = DoubleDouble<Arch>;
  using Number = typename Arch::Number;
  using Mask = typename Arch::Mask;
  using Direction = Direction2<Numbers, kUnit, kBall>;

  static constexpr double kPosition = kUnit ? kAlongOnUnit : kAlong;

  LORENTZ_INLINE RowsOf2(const Direction& to, const Bravais& lattice, const Offset<Numbers, 2>& offset)
      : to_(to), lattice_(lattice), offset_(offset) {}

  /// Chooses the anchor, from which heights and positions are counted, in the lanes of `wanted`. Returns the
  /// lanes in which there is one.
  LORENTZ_INLINE Mask set_anchor(Mask wanted) {
    const DD h = height_of_home();
    const auto& d = offset_.d;
    const Number error = offset_.error, size = Abs(d[0].hi) + Abs(d[1].hi);
    y_ = to_.sigma * h.hi;
    y_error_ = kRoundoff * Abs(y_);
    if constexpr (!kUnit) y_error_ = y_error_ + kForm * error;
    y_error_ = y_error_ + kAnchorTerms * size + all(kFlushed);
    s_ = sum_of_products(to_.along(0), d[0].hi, to_.along(1), d[1].hi);
    if constexpr (kBall)
      s_error_ = kPosition * kRoundoff * size;
    else
      s_error_ = to_.shape.along_error * size;
    if constexpr (!kUnit && kBall) s_error_ = s_error_ + kForm * error;
    if constexpr (!kUnit && !kBall)
      s_error_ = s_error_ + kForm * error * (Abs(to_.along(0)) + Abs(to_.along(1)));
    anchor_[0] = anchor_[1] = anchor_error_ = all(0);
    const Mask tiny = AndNot(to_.rho > all(kRhoOfAnchor), wanted);
    if (nowhere(tiny)) return wanted;
    return And(wanted, Or(Not(tiny), set_near_anchor(tiny, h)));
  }

  /// The number of the row beside the start, which is a fraction. The rows within reach_of_rows of it are in
  /// the strip there, and the reach includes the error of the number. On the unit lattices D_R >= 2 rho, so
  /// its terms are below 2^20, and kRowSlop covers their rounding; among tiny balls they are about 1, and the
  /// error of y counts. On other lattices the terms have no bound, and are counted as they are.
  LORENTZ_INLINE Number row_beside_start() const {
    return row_number(to_.L.S, y_, to_.L.D, s_, to_.inverse_A);
  }
  LORENTZ_INLINE Number reach_of_rows() const {
    constexpr double kRows = kRowNumber * kRoundoff;
    const auto& L = to_.L;
    if constexpr (kUnit && kBall) {
      return all(kRowSlop) + L.S * (to_.rho + anchor_error_) * to_.inverse_A;
    } else {
      const Number height = to_.rho + kRows * (Abs(y_) + to_.rho) + y_error_,
                   along = kRows * Abs(s_) + s_error_;
      return all(kRowSlop) + (L.S * height + L.D * along) * to_.inverse_A;
    }
  }

  /// The number of rows that a unit of s passes, at most.
  LORENTZ_INLINE Number slope_of_rows() const {
    const auto& L = to_.L;
    if constexpr (kUnit)
      return row_slope(L.D, to_.inverse_A);
    else
      return row_slope((L.D + L.D_error) * all(1 + kRowSlope), to_.inverse_A);
  }

  /// Do rows come one after the other?
  LORENTZ_INLINE Mask are_in_order() const {
    const auto& R = to_.R;
    Number gap = 2 * to_.rho * all(1 + kSlop2d);
    if constexpr (!kUnit) gap = gap + R.D_error;
    if constexpr (kBall)
      return R.D > gap;
    else
      return And(R.D > gap, R.S >= all(0));
  }

  /// The m at which row n enters the strip, or passes the start; it errs by at most `unsure`.
  LORENTZ_INLINE Number start_of_row(Number n, Number& unsure) const {
    const auto &R = to_.R, &L = to_.L;
    const Number nD = n * R.D, y = y_ + nD, passing = passing_of_row(s_, n, R.S, to_.inverse_S_L);
    unsure = all(kSlop2d);
    if (Arch::kOne && nowhere(to_.rises)) return passing;
    const Number m = select(to_.rises, Max(passing, entry_of_row(y, to_.rho, to_.inverse_D_L)), passing);
    Number more = (kRowEntry * kRoundoff * (Abs(y) + Abs(nD) + to_.rho) + y_error_) * to_.inverse_D_L;
    unsure = unsure + where(to_.rises, more);
    if constexpr (!kUnit) {
      more = (Abs(n) * R.D_error + Abs(m) * L.D_error) * to_.inverse_D_L;
      unsure = unsure + where(to_.rises, more);
    }
    return m;
  }

  /// The same in double-double, for rows nearly parallel to the line: the first m that can meet the strip.
  /// Returns the lanes of `wanted` for which double-double is enough.
  LORENTZ_INLINE Mask start_of_level_row(Number n, Mask wanted, Number& start) const {
    using Apart = typename Arch::Apart;
    using Wide = DoubleDouble<Apart>;
    const auto &R = to_.R, &L = to_.L;
    const Number big = all(kMaxCoefficient);
    Number N[2];
    for (int i = 0; i < 2; ++i) {
      const Number by_R = n * R.n[i];
      N[i] = anchor_[i] + by_R;
      wanted = And(wanted, And(Abs(by_R) < big, Abs(N[i]) < big));
    }
    Wide d[2];
    const Number error = place_of<kUnit>(lattice_, offset_, N, d);
    const StableMeeting<Apart, 2, kBall> meeting(to_.v, d, error, lattice_);
    const Wide h = difference_of_products(d[1], to_.v[0], d[0], to_.v[1]) * to_.sigma;
    Wide rho = Wide(all(lattice_.radius)) * sqrt(meeting.v2);
    if constexpr (!kBall) {
      const auto& scale = lattice_.shape.wide_cofactor[2][2];
      rho = rho / Wide(scale.hi < 0 ? -scale : scale);
    }
    const Wide m = (h - rho) / Wide(L.D, L.D_low);
    Number terms = meeting.across_error + kStable * (Abs(h.hi) + rho.hi);
    if constexpr (!kUnit) terms = terms + Abs(m.hi) * L.D_error;
    const Number unsure = terms / L.D + kStable * Abs(m.hi) + all(kSlop2d);
    start = Max(Ceil(m.value() - unsure), Ceil(passing_of_row(s_, n, R.S, to_.inverse_S_L) - all(kSlop2d)));
    return And(wanted, And(unsure < all(kMaxUnsure), Abs(start) < big));
  }

  /// The ball at n R + m L.
  struct Ball {
    Number h, error, s, s_error;
  };
  LORENTZ_INLINE Ball ball_at(Number n, Number m) const {
    const auto &R = to_.R, &L = to_.L;
    Ball ball;
    ball.h = height_in_row(y_, n, R.D, m, L.D);
    ball.error = kHeight * kRoundoff * (Abs(y_) + Abs(n * R.D) + Abs(m * L.D)) + y_error_;
    if constexpr (!kUnit) ball.error = ball.error + Abs(n) * R.D_error + Abs(m) * L.D_error;
    ball.s = sum_along(s_, n, R.S, m, L.S);
    ball.s_error = s_error_ + kPosition * kRoundoff * (Abs(n * R.S) + Abs(m * L.S));
    if constexpr (!kBall) ball.s_error = ball.s_error + (Abs(n) * R.S_error + Abs(m) * L.S_error);
    return ball;
  }
  LORENTZ_INLINE Number slack_of(const Ball& ball) const {
    return scaled((to_.rho - ball.h) * (to_.rho + ball.h));
  }
  LORENTZ_INLINE Number slack_error_of(const Ball& ball) const {
    return scaled(4 * to_.rho * (ball.error + to_.rho_error() * to_.rho));
  }

  /// The ball of this cell in double-double.
  template <class Coefficient>
  LORENTZ_INLINE CloseLook<typename Arch::Apart> look_closely(const Coefficient (&N)[2]) const {
    using Apart = typename Arch::Apart;
    DoubleDouble<Apart> d[2];
    const Number error = place_of<kUnit>(lattice_, offset_, N, d);
    return CloseLook<Apart>(StableMeeting<Apart, 2, kBall>(to_.v, d, error, lattice_));
  }

  /// Its coefficients in the short basis, from the home cell; true where they were not rounded.
  LORENTZ_INLINE Mask name_ball(Number n, Number m, Number (&N)[2]) const {
    const auto &R = to_.R, &L = to_.L;
    const Number big = all(kMaxCoefficient);
    Mask exact = everywhere(true);
    for (int i = 0; i < 2; ++i) {
      const Number by_R = n * R.n[i], by_L = m * L.n[i];
      N[i] = anchor_[i] + by_R + by_L;
      exact = And(exact, And(Max(Abs(by_R), Abs(by_L)) < big, Abs(N[i]) < big));
    }
    return exact;
  }

  const Direction& to_;
  const Bravais& lattice_;
  const Offset<Numbers, 2>& offset_;
  Number anchor_[2], anchor_error_;  // of an anchor that is not the home cell
  Number y_, y_error_, s_, s_error_;

 private:
  LORENTZ_INLINE Number scaled(Number slack) const {
    if constexpr (kBall)
      return slack;
    else
      return to_.shape.slack_scale * slack;
  }

  LORENTZ_INLINE DD height_of_home() const {
    const auto& d = offset_.d;
    const DD d0(d[0].hi, d[0].lo), d1(d[1].hi, d[1].lo);
    if constexpr (kUnit)
      return add_product(DD::product(d1.hi, to_.v[0]), d0.hi, Neg(to_.v[1]));
    else
      return add_product(first_product(d1, to_.v[0]), d0, Neg(to_.v[1]));
  }

  // Where it is tiny. True if no integer was rounded.
  LORENTZ_INLINE Mask set_near_anchor(Mask tiny, const DD& h) {
    const auto &R = to_.R, &L = to_.L;
    const Number big = all(kMaxCoefficient), n = Round(row_beside_start()),
                 m = Round((R.S * y_ - R.D * s_) * to_.inverse_A);
    Mask good = And(Abs(n) < big, Abs(m) < big);
    Number near[2], terms = all(0), along = all(0), s_error = s_error_;
    for (int i = 0; i < 2; ++i) {
      near[i] = (DD::product(n, R.n[i]) + DD::product(m, L.n[i])).hi;  // large terms; what they leave is not
      good = And(good, Abs(near[i]) < big);
      terms = terms + Abs(near[i]) * to_.H_size[i];
      if constexpr (kBall)
        along = along + Abs(near[i] * to_.S[i]);
      else
        s_error = s_error + to_.shape.along_error * Abs(near[i]) * all(to_.size_of[i]);
    }
    const Number y = to_.sigma * compensated_height<!kUnit>(h, near, to_.H);
    const Number y_error = y_error_ + (kAnchor * kRoundoff * Abs(y) + kAnchorTerms * terms);
    const Number s = s_ + sum_of_products(near[0], to_.S[0], near[1], to_.S[1]);
    s_error = s_error + kPosition * kRoundoff * along;
    y_ = select(tiny, y, y_), y_error_ = select(tiny, y_error, y_error_);
    s_ = select(tiny, s, s_), s_error_ = select(tiny, s_error, s_error_);
    anchor_error_ = where(tiny, y_error);
    for (int i = 0; i < 2; ++i) anchor_[i] = where(tiny, near[i]);
    return good;
  }
};
