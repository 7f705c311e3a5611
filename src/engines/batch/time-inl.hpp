// When the obstacles that were found are entered, in lanes: src/engines/reduction/entry_time.hpp and
// stable_meeting.hpp. Private to the batch engine.
#if defined(LORENTZ_BATCH_TIME_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LORENTZ_BATCH_TIME_INL_HPP
#undef LORENTZ_BATCH_TIME_INL_HPP
#else
#define LORENTZ_BATCH_TIME_INL_HPP
#endif

#include "src/engines/batch/start-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lorentz {
namespace HWY_NAMESPACE {
namespace {

/// What a search leaves for the time, and the obstacle's cell from the home cell in the short basis.
template <int D, bool kBall>
struct Entry {
  V n[D];
  V s, s_error, slack, slack_error, v2;
  // Of ellipsoids: in 2D v.v, h skew, and the relative error of v2; in 3D the form that s is.
  V euclidean_v2, across, v2_error;
  Pair along[kBall || D == 2 ? 1 : D];

  HWY_INLINE V rough_time(V& error) const {
    const V q = Sqrt(slack);
    V relative = all(kRoughTime * kRoundoff);
    if constexpr (!kBall && D == 2) relative = relative + v2_error;
    error = all(2) * (s_error + slack_error / q) / v2 + relative * s / v2;
    return (s - q) / v2;
  }

  HWY_INLINE void take(M m, const Entry& other) {
    for (int k = 0; k < D; ++k) n[k] = select(m, other.n[k], n[k]);
    s = select(m, other.s, s), s_error = select(m, other.s_error, s_error);
    slack = select(m, other.slack, slack), slack_error = select(m, other.slack_error, slack_error);
    v2 = select(m, other.v2, v2);
    if constexpr (!kBall && D == 2) {
      euclidean_v2 = select(m, other.euclidean_v2, euclidean_v2);
      across = select(m, other.across, across);
      v2_error = select(m, other.v2_error, v2_error);
    }
    if constexpr (!kBall && D == 3)
      for (int k = 0; k < D; ++k) along[k] = select(m, other.along[k], along[k]);
  }
};

/// EntryTime: the time at which the obstacle of an Entry is entered with velocity v.
template <int D, bool kUnit, bool kBall>
class Times {
 public:
  HWY_INLINE Times(const Start<D, kUnit, kBall>& start, const Entry<D, kBall>& entry, const V (&v)[D])
      : lattice_(*start.lattice), start_(start), entry_(entry), v_(v) {}

  /// Within a few ulps, for lanes of balls in which the obstacle is neither grazed nor near.
  HWY_INLINE V plain() const {
    V v2 = v_[0] * v_[0] + v_[1] * v_[1], s = v_[0] * distance(0);
    if constexpr (D == 3) v2 = v2 + v_[2] * v_[2];
    for (int k = 1; k < D; ++k) s = s + v_[k] * distance(k);
    return (s - Sqrt(entry_.slack)) / v2;
  }
  /// The same where the obstacle may be near: near_ball, and one division for both.
  HWY_INLINE V plain_or_near() const {
    const V q = Sqrt(entry_.slack);
    const M near = is_near(q);
    if (nowhere(near)) return plain();
    Pair d[D];
    start_.place(entry_.n, d);
    V v2 = none(), s = none();
    for (int k = 0; k < D; ++k) {
      const V place = kUnit ? d[k].hi : select(near, d[k].hi, distance(k));  // the bits of a single flight
      v2 = v2 + v_[k] * v_[k], s = s + v_[k] * place;
    }
    return select(near, gap_of_ball(d, lattice_.radius), s - q) / select(near, s + q, v2);
  }
  HWY_INLINE M is_grazed() const { return is_grazing(Sqrt(entry_.slack)); }
  /// In double-double, for lanes of balls in which the obstacle is grazed.
  HWY_INLINE V grazed() const { return rare(); }
  HWY_INLINE M is_grazing(V q) const { return entry_.slack_error > all(kGrazing * kRoundoff) * q * entry_.s; }
  HWY_INLINE M is_near(V q) const { return Not(entry_.s > all(kNear) * q); }

  /// Within a few ulps, for the lanes of `hit`.
  HWY_INLINE V close(M hit) const {
    if constexpr (kBall)
      return close_of_ball(hit);
    else
      return close_of_ellipsoid(hit);
  }

  /// Correctly rounded, in the lanes of is_rounded: in double-double, and the bound of its error.
  HWY_INLINE V rounded(M& is_rounded) const {
    const Wide wide = wide_of(asked());
    const V time = wide.time.hi + (wide.time.lo + wide.error);
    is_rounded = time == wide.time.hi + (wide.time.lo - wide.error);
    return time;
  }

  /// The same in few operations, among small balls, in most lanes; in the others is_rounded may be true of
  /// `rounded`. (q is computed in binary64: it errs by some of its roundoffs, which are few of those of s - q
  /// if the obstacle is far. docs/bounds.md)
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

  /// Are the obstacles so small that it pays?
  HWY_INLINE bool are_soon_rounded() const { return kBall && lattice_.radius < kSoonRadius; }

 private:
  HWY_INLINE V soon_placed(Pair (&d)[D]) const {
    if constexpr (!kUnit) return start_.place(entry_.n, d);
    for (int k = 0; k < D; ++k)
      d[k] = Pair::ordered_sum(entry_.n[k], start_.d[k].hi);  // an integer, and 1/2 at most
    return none();
  }

  // a . b, but for some squares of the roundoff.
  static HWY_INLINE Pair soon_product(const V (&a)[D], const V (&b)[D]) {
    Pair sum = Pair::product(a[0], b[0]);
    for (int k = 1; k < D; ++k) {
      const Pair next = Pair::product(a[k], b[k]), both = Pair::sum(sum.hi, next.hi);
      sum = {both.hi, both.lo + (sum.lo + next.lo)};
    }
    return sum;
  }

  // In the plane from v x d, by Kahan's difference of products: the search's has the errors of large heights.
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
    V n[D], v[D], q;
  };
  struct Wide {
    Pair time;
    V error;
  };

  HWY_INLINE Asked asked(V q = none()) const {
    Asked asked;
    asked.start = start_, asked.q = q;
    for (int k = 0; k < D; ++k) asked.n[k] = entry_.n[k], asked.v[k] = v_[k];
    return asked;
  }

  static HWY_NOINLINE Wide wide_of(const Asked& asked) { return measured(asked); }

  // The same without the bound, which is not computed then.
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

  HWY_INLINE V close_of_ball(M hit) const {
    const V q = Sqrt(entry_.slack);
    const M grazing = And(hit, is_grazing(q)), near = And(hit, is_near(q));
    V time = plain();
    if (any(near)) time = select(near, near_ball(asked(q)), time);
    if (any(grazing)) time = select(grazing, rare(), time);
    return time;
  }

  HWY_INLINE V rare() const { return rare_of(asked()); }

  static HWY_NOINLINE V near_ball(const Asked& asked) {
    Pair d[D];
    asked.start.place(asked.n, d);
    V s = none();
    for (int k = 0; k < D; ++k) s = s + asked.v[k] * d[k].hi;
    return gap_of_ball(d, asked.start.lattice->radius) / (s + asked.q);
  }

  // |d|^2 - r^2, at least 0.
  static HWY_INLINE V gap_of_ball(const Pair (&d)[D], double r) {
    Pair gap = -Pair::product(all(r), all(r));
    for (int k = 0; k < D; ++k) {
      const Pair square = Pair::product(d[k].hi, d[k].hi), sum = Pair::sum(gap.hi, square.hi);
      gap = Pair{sum.hi, sum.lo + (gap.lo + square.lo + all(2) * d[k].hi * d[k].lo)};
    }
    return Max(gap.value(), none());
  }

  HWY_INLINE V close_of_ellipsoid(M hit) const {
    const V q = Sqrt(entry_.slack);
    const double condition = lattice_.shape.condition;
    if (condition > kSlender) return Max(rare(), none());
    const double unsure = (kGrazing + kGrazingOfShape * condition) * kRoundoff;
    const M grazing = And(hit, entry_.slack_error > all(unsure) * q * entry_.s);
    V time;
    if constexpr (D == 2) {
      const V along = v_[0] * distance(0) + v_[1] * distance(1);
      const V v2 = entry_.v2, euclidean_v2 = entry_.euclidean_v2, across = entry_.across;
      const M near = And(hit, Not(entry_.s > all(kNear) * q));
      time = along / euclidean_v2 + (across - q * euclidean_v2) / (euclidean_v2 * v2);
      if (any(near)) time = select(near, close_gap() / ((along * v2 + across) / euclidean_v2 + q), time);
    } else {
      Pair d[D];
      place(d);
      time = Max((close_product(entry_.along, d).hi - q) / entry_.v2, none());
    }
    if (any(grazing)) time = select(grazing, rare(), time);
    return time;
  }

  HWY_INLINE void place(Pair (&d)[D]) const {
    for (int k = 0; k < D; ++k) {
      if constexpr (kUnit) {
        d[k] = Pair::sum(entry_.n[k], start_.d[k].hi);
      } else {
        Pair sum = start_.d[k];
        for (int i = 0; i < D; ++i) sum = add_product(sum, Pair(lattice_.basis[i][k]), entry_.n[i]);
        d[k] = sum;
      }
    }
  }

  static HWY_INLINE Pair close_product(const Pair (&a)[D], const Pair (&d)[D]) {
    Pair sum = first_product(a[0], d[0].hi);
    V low = a[0].hi * d[0].lo;
    for (int k = 1; k < D; ++k) {
      sum = add_product(sum, a[k], d[k].hi);
      low = low + a[k].hi * d[k].lo;
    }
    return Pair::sum(sum.hi, sum.lo + low);
  }

  HWY_INLINE V close_gap() const {
    Pair d[D], image[D];
    place(d);
    for (int i = 0; i < D; ++i) {
      Pair row[D];
      for (int k = 0; k < D; ++k) row[k] = Pair(lattice_.shape.metric[i][k]);
      image[i] = close_product(row, d);
    }
    const Pair square = close_product(image, d),
               limit = Pair::product(all(lattice_.radius), all(lattice_.radius));
    return Max((square.hi - limit.hi) + (square.lo - limit.lo), none());
  }

  HWY_INLINE V distance(int k) const {
    if constexpr (kUnit) return entry_.n[k] + start_.d[k].hi;
    V d = start_.d[k].hi;
    for (int i = 0; i < D; ++i) d = d + all(lattice_.basis[i][k].hi) * entry_.n[i];
    return d;
  }

  const Bravais& lattice_;
  const Start<D, kUnit, kBall>& start_;
  const Entry<D, kBall>& entry_;
  const V (&v_)[D];
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace lorentz
HWY_AFTER_NAMESPACE();

#endif
