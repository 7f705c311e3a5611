// When the obstacles found are entered, in lanes, as in src/engines/reduction/entry_time.hpp. Private to the
// batch engine.

/// The results of a search from which the time is computed, and the obstacle's cell relative to the home
/// cell, in the short basis.
template <int D, bool kBall>
struct LaneEntry : Entry<LaneFma, D, kBall> {
  V n[D];

  HWY_INLINE void take(M m, const LaneEntry& other) {
    for (int k = 0; k < D; ++k) n[k] = select(m, other.n[k], n[k]);
    this->s = select(m, other.s, this->s), this->s_error = select(m, other.s_error, this->s_error);
    this->slack = select(m, other.slack, this->slack);
    this->slack_error = select(m, other.slack_error, this->slack_error);
    this->v2 = select(m, other.v2, this->v2);
    if constexpr (!kBall && D == 2) {
      this->euclidean_v2 = select(m, other.euclidean_v2, this->euclidean_v2);
      this->across = select(m, other.across, this->across);
      this->v2_error = select(m, other.v2_error, this->v2_error);
    }
    if constexpr (!kBall && D == 3)
      for (int k = 0; k < D; ++k) this->along[k] = select(m, other.along[k], this->along[k]);
  }
};

/// The time at which the obstacle of an entry is entered with velocity v.
template <int D, bool kUnit, bool kBall>
class Times : public CloseTime<Times<D, kUnit, kBall>, LaneFma, LaneFma, D, kUnit, kBall, V, V[D]> {
  using Base = CloseTime<Times<D, kUnit, kBall>, LaneFma, LaneFma, D, kUnit, kBall, V, V[D]>;
  using Base::lattice_, Base::entry_, Base::v_, Base::distance, Base::gap_of_ball, Base::is_near;

 public:
  HWY_INLINE Times(const Start<D, kUnit, kBall>& start, const LaneEntry<D, kBall>& entry, const V (&v)[D])
      : Base(*start.lattice, start, entry.n, entry, v), start_(start), n_(entry.n) {}

  /// For balls that are not grazed: CloseTime::close, with one division for near and distant balls alike.
  HWY_INLINE V plain_or_near() const {
    const V q = Sqrt(entry_.slack);
    const M near = is_near(q);
    if (nowhere(near)) return this->plain(q);
    Pair d[D];
    start_.place(n_, d);
    V v2 = none(), s = none();
    for (int k = 0; k < D; ++k) {
      const V place = kUnit ? d[k].hi : select(near, d[k].hi, distance(k));  // the bits of a single flight
      v2 = v2 + v_[k] * v_[k], s = s + v_[k] * place;
    }
    return select(near, gap_of_ball(d), s - q) / select(near, s + q, v2);
  }
  HWY_INLINE M is_grazed() const { return this->is_grazing(Sqrt(entry_.slack)); }
  /// In double-double, for grazed obstacles and other rare cases.
  HWY_INLINE V rare_time() const { return rare_of(asked()); }

  /// The time from double-double and the bound of its error, correctly rounded in the lanes of is_rounded.
  HWY_INLINE V rounded(M& is_rounded) const {
    const Wide wide = wide_of(asked());
    const V time = wide.time.hi + (wide.time.lo + wide.error);
    is_rounded = time == wide.time.hi + (wide.time.lo - wide.error);
    return time;
  }

  /// The same in few operations, for small balls. It succeeds in most lanes; in the others `rounded` may
  /// still set is_rounded. (q is computed in binary64. It errs by a few of its own roundoffs, which are few
  /// of those of s - q if the obstacle is far. docs/bounds.md)
  HWY_INLINE V soon_rounded(M& is_rounded) const {
    const double reach = 4 * lattice_.radius;  // rho is less
    Pair d[D];
    V here[D], s_error = none();
    const V place_error = soon_placed(d);
    for (int k = 0; k < D; ++k) here[k] = d[k].hi;
    const Pair v2 = soon_product(v_, v_);
    Pair s = soon_product(here, v_);
    for (int k = 0; k < D; ++k) s.lo = MulAdd(d[k].lo, v_[k], s.lo);
    s_error = all(kSoonTime) * (s.hi + all(reach));
    if constexpr (!kUnit) s_error = s_error + all(64) * place_error;
    V slack_error;
    const V q = Sqrt(soon_slack(d, v2.hi, slack_error)), shared = all(1) / (v2.hi * q), inverse = shared * q;
    const V high = s.hi - q, low = ((s.hi - high) - q) + s.lo;
    const V rough = high * inverse;
    const V rest = (NegMulAdd(rough, v2.hi, high) + NegMulAdd(rough, v2.lo, low)) * inverse;
    const V q_unit = select(s.hi > all(kFarSlack) * q, all(16 * kRoundoff), all(2 * kRoundoff));
    const V error = all(1 + kAmple) * MulAdd(slack_error + all(4 * reach) * s_error, shared,
                                             MulAdd(q_unit, q, s_error) * inverse);
    const V time = rough + (rest + error);
    is_rounded = And(time == rough + (rest - error), s.hi > all(kNear) * q);
    return time;
  }

  /// Are the obstacles so small that soon_rounded pays?
  HWY_INLINE bool are_soon_rounded() const { return kBall && lattice_.radius < kSoonRadius; }

 private:
  HWY_INLINE V soon_placed(Pair (&d)[D]) const {
    if constexpr (!kUnit) return start_.place(n_, d);
    for (int k = 0; k < D; ++k)
      d[k] = Pair::ordered_sum(n_[k], start_.d[k].hi);  // an integer, and 1/2 at most
    return none();
  }

  // a . b, up to a few squares of the roundoff.
  static HWY_INLINE Pair soon_product(const V (&a)[D], const V (&b)[D]) {
    Pair sum = Pair::product(a[0], b[0]);
    for (int k = 1; k < D; ++k) {
      const Pair next = Pair::product(a[k], b[k]), both = Pair::sum(sum.hi, next.hi);
      sum = {both.hi, both.lo + (sum.lo + next.lo)};
    }
    return sum;
  }

  // In the plane the slack is computed from v x d, by Kahan's difference of products, because the slack of
  // the search has the errors of large heights.
  HWY_INLINE V soon_slack(const Pair (&d)[D], V v2, V& error) const {
    if constexpr (D == 3) {
      error = entry_.slack_error;
      return entry_.slack;
    } else {
      const V product = d[0].hi * v_[1];
      const V rest = NegMulAdd(d[0].hi, v_[1], product) + NegMulAdd(d[0].lo, v_[1], d[1].lo * v_[0]);
      const V h = MulSub(d[1].hi, v_[0], product) + rest, rho2 = all(lattice_.radius * lattice_.radius) * v2;
      error = all(kSoonSlack * kRoundoff) * rho2;
      return NegMulAdd(h, h, rho2);
    }
  }

  struct Asked {
    Start<D, kUnit, kBall> start;
    V n[D], v[D];
  };
  struct Wide {
    Pair time;
    V error;
  };

  HWY_INLINE Asked asked() const {
    Asked asked;
    asked.start = start_;
    for (int k = 0; k < D; ++k) asked.n[k] = n_[k], asked.v[k] = v_[k];
    return asked;
  }

  static HWY_NOINLINE Wide wide_of(const Asked& asked) { return measured(asked); }

  // The same without the bound, which is then not computed.
  static HWY_NOINLINE V rare_of(const Asked& asked) { return measured(asked).time.value(); }

  static HWY_INLINE Wide measured(const Asked& asked) {
    const Bravais& lattice = *asked.start.lattice;
    Pair d[D];
    const V d_error = asked.start.place(asked.n, d);
    const StableMeeting<LaneFma, D, kBall> meeting(asked.v, d, d_error, lattice);
    Wide wide;
    wide.time = meeting.time(d, d_error, lattice, wide.error);
    return wide;
  }

  const Start<D, kUnit, kBall>& start_;
  const V (&n_)[D];
};
