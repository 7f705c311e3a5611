// When an obstacle that was found is entered: roughly, and within a few ulps. Both engines get the rest,
// in double-double, from StableMeeting.

/// The results of the search from which the time is computed: s = v . d, and the slack, whose root q is half
/// the chord.
template <class Numbers, int D, bool kBall>
struct Entry {
  using Number = typename Numbers::Number;

  Number s, s_error, slack, slack_error, v2;
  // For ellipsoids: in 2D v.v, h skew, and the relative error of v2; in 3D the form whose value is s.
  Number euclidean_v2, across, v2_error;
  DoubleDouble<Numbers> along[kBall || D == 2 ? 1 : D];

  /// The time in binary64, and a bound on its error.
  LORENTZ_INLINE Number rough_time(Number& error) const {
    const Number q = sqrt(slack);
    Number relative = all(kRoughTime * kRoundoff);
    if constexpr (!kBall && D == 2) relative = relative + v2_error;
    error = 2 * (s_error + slack_error / q) / v2 + relative * s / v2;
    return rough_time_of(s, q, v2);
  }
};

/// The time at which the obstacle of cell N is entered with velocity v. Self has rare_time(), the time in
/// double-double for rare cases. N: integers, in binary64 or in double-double.
template <class Self, class Arch, class Numbers, int D, bool kUnit, bool kBall, class Coefficient,
          class Vector>
class CloseTime {
 protected:
  using Number = typename Arch::Number;
  using Mask = typename Arch::Mask;
  using DD = DoubleDouble<Arch>;

  LORENTZ_INLINE CloseTime(const Bravais& lattice, const Offset<Numbers, D>& offset,
                           const Coefficient (&N)[D], const Entry<Numbers, D, kBall>& entry, const Vector& v)
      : lattice_(lattice), offset_(offset), N_(N), entry_(entry), v_(v) {}

 public:
  /// The time within a few ulps, for hits.
  LORENTZ_INLINE Number close(Mask hit) const {
    if constexpr (kBall)
      return close_of_ball(hit);
    else
      return close_of_ellipsoid(hit);
  }

 protected:
  /// For balls.
  LORENTZ_INLINE Mask is_grazing(Number q) const {
    return entry_.slack_error > kGrazing * kRoundoff * q * entry_.s;
  }
  LORENTZ_INLINE Mask is_near(Number q) const { return Not(entry_.s > kNear * q); }

  /// For balls that are neither grazed nor near.
  LORENTZ_INLINE Number plain(Number q) const {
    Number v2 = v_[0] * v_[0], s = v_[0] * distance(0);
    for (int k = 1; k < D; ++k) v2 = v2 + v_[k] * v_[k], s = s + v_[k] * distance(k);
    return (s - q) / v2;
  }

  /// For near balls the difference s - q would cancel. It is (s^2 - q^2) / (s + q), where s^2 - q^2 = v^2
  /// (|d|^2 - r^2).
  LORENTZ_INLINE Number near_ball(Number q) const {
    DD d[D];
    place_of<kUnit>(lattice_, offset_, N_, d);
    Number s = all(0);
    for (int k = 0; k < D; ++k) s = s + v_[k] * d[k].hi;
    return gap_of_ball(d) / (s + q);
  }

  /// |d|^2 - r^2, at least 0.
  LORENTZ_INLINE Number gap_of_ball(const DD (&d)[D]) const {
    DD gap = -DD::product(all(lattice_.radius), all(lattice_.radius));
    for (int k = 0; k < D; ++k) {
      const DD square = DD::product(d[k].hi, d[k].hi), sum = DD::sum(gap.hi, square.hi);
      gap = DD(sum.hi, sum.lo + (gap.lo + square.lo + 2 * d[k].hi * d[k].lo));
    }
    return Max(gap.value(), all(0));
  }

  /// Component k of the obstacle's place relative to x, within a few ulps of |d|.
  LORENTZ_INLINE Number distance(int k) const {
    if constexpr (kUnit) return high(N_[k]) + offset_.d[k].hi;
    Number d = offset_.d[k].hi;
    if (lattice_.rank == 0) return d;
    for (int i = 0; i < D; ++i) d = d + all(lattice_.basis[i][k].hi) * high(N_[i]);
    return d;
  }

  const Bravais& lattice_;
  const Offset<Numbers, D>& offset_;
  const Coefficient (&N_)[D];
  const Entry<Numbers, D, kBall>& entry_;
  const Vector& v_;

 private:
  static constexpr bool kWide = !std::is_same_v<Coefficient, Number>;

  static LORENTZ_INLINE Number high(const Coefficient& n) {
    if constexpr (kWide)
      return n.hi;
    else
      return n;
  }
  // At least +0, as every time is.
  LORENTZ_INLINE Number rare() const {
    return Max(static_cast<const Self&>(*this).rare_time(), all(0)) + all(0);
  }

  LORENTZ_INLINE Number close_of_ball(Mask hit) const {
    const Number q = sqrt(entry_.slack);
    const Mask grazing = And(hit, is_grazing(q)), near = And(hit, is_near(q));
    if (Arch::kOne && any(grazing)) return rare();
    if (Arch::kOne && any(near)) return near_ball(q);
    Number time = plain(q);
    if (any(near)) time = select(near, near_ball(q), time);
    if (any(grazing)) time = select(grazing, rare(), time);
    return time;
  }

  // The terms of along . d are larger than their sum. In 2D the sum is ((v . d) v2 + h skew) / v.v, and h is
  // known; in 3D it is computed in double-double. In 3D the error bound of the slack is so large that near
  // obstacles have already gone to the second stage.
  LORENTZ_INLINE Number close_of_ellipsoid(Mask hit) const {
    const Number q = sqrt(entry_.slack);
    const double condition = lattice_.shape.condition;
    // For a slender ellipsoid the last bits of h change the time by more than a few ulps.
    if (condition > kSlender) return Max(rare(), all(0));
    const double unsure =
        (kGrazing + kGrazingOfShape * condition) * kRoundoff;  // the second term: the bounds are larger
    const Mask grazing = And(hit, entry_.slack_error > unsure * q * entry_.s);
    if (Arch::kOne && any(grazing)) return rare();
    Number time;
    if constexpr (D == 2)
      time = close_in_plane(hit, q);
    else
      time = close_in_space(q);
    if (any(grazing)) time = select(grazing, rare(), time);
    return time;
  }

  // For near obstacles s - q would cancel; there t = (d . G d - r^2) / (s + q).
  LORENTZ_INLINE Number close_in_plane(Mask hit, Number q) const {
    const Number v2 = entry_.v2, euclidean_v2 = entry_.euclidean_v2, across = entry_.across,
                 along = v_[0] * distance(0) + v_[1] * distance(1);
    const Mask near = And(hit, is_near(q));
    const Number far_time = along / euclidean_v2 + (across - q * euclidean_v2) / (euclidean_v2 * v2);
    if (nowhere(near)) return far_time;
    return select(near, close_gap() / ((along * v2 + across) / euclidean_v2 + q), far_time);
  }

  LORENTZ_INLINE Number close_in_space(Number q) const {
    DD d[D], along[D];
    place(d);
    for (int k = 0; k < D; ++k) along[k] = DD(entry_.along[k].hi, entry_.along[k].lo);
    return Max((close_product(along, d).hi - q) / entry_.v2, all(0));
  }

  // d . G d - r^2, at least 0.
  LORENTZ_INLINE Number close_gap() const {
    DD d[D], image[D];
    place(d);
    for (int i = 0; i < D; ++i) {
      DD row[D];
      for (int k = 0; k < D; ++k) row[k] = DD(lattice_.shape.metric[i][k]);
      image[i] = close_product(row, d);
    }
    const DD square = close_product(image, d),
             limit = DD::product(all(lattice_.radius), all(lattice_.radius));
    return Max((square.hi - limit.hi) + (square.lo - limit.lo), all(0));
  }

  // The obstacle's place relative to x, with an error of a few squares of the roundoff of its terms: place_of
  // in fewer operations.
  LORENTZ_INLINE void place(DD (&d)[D]) const {
    for (int k = 0; k < D; ++k) {
      if constexpr (kUnit) {
        d[k] = DD::sum(high(N_[k]), offset_.d[k].hi);
        if constexpr (kWide) d[k].lo = d[k].lo + N_[k].lo;
      } else {
        DD sum(offset_.d[k].hi, offset_.d[k].lo);
        Number low = all(0);
        for (int i = 0; i < D; ++i) {
          sum = add_product(sum, DD(lattice_.basis[i][k]), high(N_[i]));
          if constexpr (kWide) low = low + lattice_.basis[i][k].hi * N_[i].lo;
        }
        d[k] = kWide ? DD(sum.hi, sum.lo + low) : sum;
      }
    }
  }

  // a . d, with an error of a few roundoffs of the result and a few squares of the roundoff of the terms.
  static LORENTZ_INLINE DD close_product(const DD (&a)[D], const DD (&d)[D]) {
    DD sum = first_product(a[0], d[0].hi);
    Number low = a[0].hi * d[0].lo;
    for (int k = 1; k < D; ++k) {
      sum = add_product(sum, a[k], d[k].hi);
      low = low + a[k].hi * d[k].lo;
    }
    return DD::sum(sum.hi, sum.lo + low);
  }
};
