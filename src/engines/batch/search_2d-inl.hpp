// The search for the first obstacles in 2D, in lanes: src/engines/reduction/search_2d.hpp. Private to the
// batch engine.
#if defined(LORENTZ_BATCH_SEARCH_2D_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LORENTZ_BATCH_SEARCH_2D_INL_HPP
#undef LORENTZ_BATCH_SEARCH_2D_INL_HPP
#else
#define LORENTZ_BATCH_SEARCH_2D_INL_HPP
#endif

#include "src/engines/batch/time-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lorentz {
namespace HWY_NAMESPACE {
namespace {

/// The first obstacles of one atom, one start a lane.
template <bool kUnit, bool kBall>
class Search2 {
 public:
  using Direction = Direction2<LaneFma, kUnit, kBall>;
  using AtomStart = Start<2, kUnit, kBall>;

  /// `d`: the start's, turned as the direction is. `leaving`: turned, or null.
  HWY_INLINE Search2(const Direction& to, const AtomStart& start, const Pair (&d)[2],
                     const Leaving<2>* leaving, V s_limit)
      : to_(to), start_(start), d_(d), leaving_(leaving), s_limit_(s_limit) {}

  LaneEntry<2, kBall> found;  ///< of the lanes in which something is met: found.s is finite

  /// Of the lanes that are active. Row by row, and in a row ball by ball: each turn looks at one ball a lane.
  HWY_INLINE void run(Lanes& lanes) {
    set_anchor(lanes);
    start_rows(lanes);
    M scanning = lanes.active, next = scanning;
    for (int turn = 0; any(scanning); ++turn) {
      if (turn == kMaxTurns) return lanes.leave(scanning);
      begin_rows(lanes, scanning, next);
      if (nowhere(scanning)) return;
      look(lanes, scanning, next);
    }
  }

 private:
  // So that in no row more balls are looked at than a single flight looks at.
  static constexpr int kMaxTurns = kMaxCandidatesInRow;

  HWY_INLINE void set_anchor(Lanes& lanes) {
    const auto &R = to_.R, &L = to_.L;
    const V error = start_.error;
    const Pair h = add_product(first_product(d_[1], to_.v[0]), d_[0], Neg(to_.v[1]));
    const V size = Abs(d_[0].hi) + Abs(d_[1].hi);
    y_ = to_.sigma * h.hi;
    y_error_ = all(kRoundoff) * Abs(y_);
    if constexpr (!kUnit) y_error_ = y_error_ + all(kForm) * error;
    y_error_ = y_error_ + all(kAnchorTerms) * size + all(kFlushed);
    s_ = to_.along(0) * d_[0].hi + to_.along(1) * d_[1].hi;
    s_error_ = (kBall ? all(kAlong * kRoundoff) : to_.shape.along_error) * size;
    if constexpr (!kUnit && kBall) s_error_ = s_error_ + all(kForm) * error;
    if constexpr (!kUnit && !kBall)
      s_error_ = s_error_ + all(kForm) * error * (Abs(to_.along(0)) + Abs(to_.along(1)));
    anchor_[0] = anchor_[1] = anchor_error_ = none();
    const M tiny = AndNot(to_.rho > all(kRhoOfAnchor), lanes.active);
    if (any(tiny)) set_near_anchor(tiny, h, lanes);
  }

  // Among tiny balls: the lattice point nearest to the start in the coordinates of R and L, or another one
  // nearby: any will do whose coefficients are integers without rounding.
  HWY_INLINE void set_near_anchor(M tiny, Pair h, Lanes& lanes) {
    const auto &R = to_.R, &L = to_.L;
    const V big = all(kMaxCoefficient);
    const V n = Round(Neg(L.S * y_ + L.D * s_) * to_.inverse_A);
    const V m = Round((R.S * y_ - R.D * s_) * to_.inverse_A);
    V anchor[2], terms = none(), along = none(), s_error = s_error_;
    for (int i = 0; i < 2; ++i) {
      const Pair sum = Pair::product(n, R.n[i]) + Pair::product(m, L.n[i]);
      lanes.leave(And(tiny, Not(Abs(sum.hi) < big)));
      anchor[i] = sum.hi;
      terms = terms + Abs(anchor[i]) * to_.H_size[i];
      if constexpr (kBall)
        along = along + Abs(anchor[i] * to_.S[i]);
      else
        s_error = s_error + to_.shape.along_error * Abs(anchor[i]) * all(to_.size_of[i]);
    }
    const Pair a = Pair::product(anchor[0], to_.H[0].hi), b = Pair::product(anchor[1], to_.H[1].hi),
               ab = Pair::sum(a.hi, b.hi), sum = Pair::sum(ab.hi, h.hi);
    V low = (a.lo + b.lo) + (ab.lo + sum.lo) + h.lo;
    if constexpr (!kUnit) low = low + (anchor[0] * to_.H[0].lo + anchor[1] * to_.H[1].lo);
    const V y = to_.sigma * (sum.hi + low);
    const V y_error = y_error_ + (all(kAnchor * kRoundoff) * Abs(y) + all(kAnchorTerms) * terms);
    const V s = s_ + (anchor[0] * to_.S[0] + anchor[1] * to_.S[1]);
    s_error = s_error + all(kAlong * kRoundoff) * along;
    y_ = select(tiny, y, y_), y_error_ = select(tiny, y_error, y_error_);
    s_ = select(tiny, s, s_), s_error_ = select(tiny, s_error, s_error_);
    anchor_error_ = where(tiny, y_error);
    for (int i = 0; i < 2; ++i) anchor_[i] = where(tiny, anchor[i]);
  }

  HWY_INLINE V reach_of_rows() const {
    constexpr double kRows = kRowNumber * kRoundoff;
    const auto& L = to_.L;
    if constexpr (kUnit && kBall) return all(kRowSlop) + L.S * (to_.rho + anchor_error_) * to_.inverse_A;
    const V height = to_.rho + all(kRows) * (Abs(y_) + to_.rho) + y_error_,
            along = all(kRows) * Abs(s_) + s_error_;
    return all(kRowSlop) + (L.S * height + L.D * along) * to_.inverse_A;
  }

  HWY_INLINE void start_rows(Lanes& lanes) {
    const auto &R = to_.R, &L = to_.L;
    const V nu = Neg(L.S * y_ + L.D * s_) * to_.inverse_A, reach = reach_of_rows();
    lanes.leave_unless(Abs(nu) + reach < all(kMaxCoefficient));
    slope_ = (kUnit ? L.D : (L.D + L.D_error) * all(1 + kRowSlope)) * to_.inverse_A;
    n_ = Ceil(nu - reach);
    last_ = nu + reach;
    m_ = none();
    found.s = infinite();
    found.s_error = found.slack = found.slack_error = found.across = none();
    found.n[0] = found.n[1] = none();
    found.v2 = to_.v2;
    if constexpr (!kBall)
      found.euclidean_v2 = to_.shape.euclidean_v2, found.v2_error = all(2 * to_.rho_error());
    V gap = all(2) * to_.rho * all(1 + kSlop2d);
    if constexpr (!kUnit) gap = gap + R.D_error;
    in_order_ = R.D > gap;  // rows come one after the other
    if constexpr (!kBall) in_order_ = And(in_order_, R.S >= none());
  }

  // The lanes of `next` begin row n_, at the m at which it enters the strip.
  HWY_INLINE void begin_rows(Lanes& lanes, M& scanning, M next) {
    const auto &R = to_.R, &L = to_.L;
    const V last = select(to_.rises, last_ + Min(found.s, s_limit_) * slope_, last_);
    scanning = AndNot(And(next, Not(n_ <= last)), scanning);
    next = And(next, scanning);
    const V nD = n_ * R.D, y = y_ + nD;
    V m = Neg(s_ + n_ * R.S) * to_.inverse_S_L, unsure = all(kSlop2d);
    m = select(to_.rises, Max(m, (y - to_.rho) * to_.inverse_D_L), m);
    V more = (all(kRowEntry * kRoundoff) * (Abs(y) + Abs(nD) + to_.rho) + y_error_) * to_.inverse_D_L;
    unsure = unsure + where(to_.rises, more);
    if constexpr (!kUnit) {
      more = (Abs(n_) * R.D_error + Abs(m) * L.D_error) * to_.inverse_D_L;
      unsure = unsure + where(to_.rises, more);
    }
    const M rare = And(next, unsure > all(kMaxUnsure));
    lanes.leave(rare);
    scanning = AndNot(rare, scanning);
    m_ = select(next, Ceil(m - unsure), m_);
  }

  // The ball at n_ R + m_ L: look_at. What is taken or beyond ends the row.
  HWY_INLINE void look(Lanes& lanes, M& scanning, M& next) {
    const auto &R = to_.R, &L = to_.L;
    const V rho = to_.rho, big = all(kMaxCoefficient), zero = none();
    const V nD = n_ * R.D, mD = m_ * L.D, nS = n_ * R.S, mS = m_ * L.S;
    const V h = (y_ + nD) - mD;
    V error = all(kHeight * kRoundoff) * (Abs(y_) + Abs(nD) + Abs(mD)) + y_error_;
    if constexpr (!kUnit) error = error + Abs(n_) * R.D_error + Abs(m_) * L.D_error;
    const V s = (s_ + nS) + mS;
    V s_error = s_error_ + all(kAlong * kRoundoff) * (Abs(nS) + Abs(mS));
    if constexpr (!kBall) s_error = s_error + (Abs(n_) * R.S_error + Abs(m_) * L.S_error);
    const V spread = error + all(to_.rho_error()) * rho;
    const M yes = Abs(h) + spread<rho, no = Abs(h) - spread> rho;
    const M passed = Or(h < zero, Not(to_.rises));
    const M behind = s<Neg(s_error), late = s - s_error> Min(found.s + found.s_error, s_limit_);
    M candidate = AndNot(Or(no, Or(behind, late)), scanning);
    const V na = n_ * R.n[0], nb = n_ * R.n[1], ma = m_ * L.n[0], mb = m_ * L.n[1];
    const V N[2] = {anchor_[0] + na + ma, anchor_[1] + nb + mb};
    const V size = Max(largest(Abs(na), Abs(nb), Abs(ma)), largest(Abs(mb), Abs(N[0]), Abs(N[1])));
    const M exact = size < big;
    M left = no_lane();
    if (leaving_ != nullptr) {
      left =
          And(And(candidate, exact), And(leaving_->any, And(N[0] == leaving_->n[0], N[1] == leaving_->n[1])));
      candidate = AndNot(left, candidate);
    }
    const M certain = And(And(yes, exact), And(s > s_error, s + s_error < found.s - found.s_error));
    const M take = And(candidate, certain), doubtful = AndNot(certain, candidate);
    lanes.leave(doubtful);
    scanning = AndNot(doubtful, scanning);
    found.n[0] = select(take, N[0], found.n[0]), found.n[1] = select(take, N[1], found.n[1]);
    found.s = select(take, s, found.s), found.s_error = select(take, s_error, found.s_error);
    found.slack = select(take, scaled((rho - h) * (rho + h)), found.slack);
    found.slack_error =
        select(take, scaled(all(4) * rho * (error + all(to_.rho_error()) * rho)), found.slack_error);
    if constexpr (!kBall) found.across = select(take, to_.sigma * h * to_.shape.skew, found.across);
    // Before the strip, behind the start, or left: on in the row.
    const M before = And(scanning, Or(left, Or(AndNot(passed, no), AndNot(no, behind))));
    m_ = m_ + all(1);
    next = AndNot(before, scanning);
    const M over = And(And(next, found.s < infinite()), in_order_);
    scanning = AndNot(over, scanning), next = AndNot(over, next);
    n_ = select(next, n_ + all(1), n_);
  }

  HWY_INLINE V scaled(V slack) const {
    if constexpr (kBall) return slack;
    return all(to_.slack_scale()) * slack;
  }

  const Direction& to_;
  const AtomStart& start_;
  const Pair (&d_)[2];
  const Leaving<2>* leaving_;
  V s_limit_;
  V anchor_[2], anchor_error_, y_, y_error_, s_, s_error_;
  V slope_, n_, m_, last_;
  M in_order_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace lorentz
HWY_AFTER_NAMESPACE();

#endif
