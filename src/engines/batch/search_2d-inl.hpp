// The search for the first obstacles in 2D, in lanes, as in src/engines/reduction/search_2d.hpp. Private to
// the batch engine.

/// The first obstacles of one atom, with one start per lane.
template <bool kUnit, bool kBall>
class LaneSearch2 : RowsOf2<LaneFma, LaneFma, kUnit, kBall> {
  using Rows = RowsOf2<LaneFma, LaneFma, kUnit, kBall>;
  using Rows::to_;
  using Close = CloseLook<LaneFma>;

 public:
  using Direction = Direction2<LaneFma, kUnit, kBall>;

  /// `start` and `leaving` are turned as the direction is; `leaving` may be null.
  HWY_INLINE LaneSearch2(const Direction& to, const Bravais& lattice, const Offset<LaneFma, 2>& start,
                         const Leaving<2>* leaving, V s_limit)
      : Rows(to, lattice, start), leaving_(leaving), s_limit_(s_limit) {}

  LaneEntry<2, kBall> found;  ///< for the lanes that meet an obstacle: there found.s is finite
  M stage2;                   ///< the lanes in which double-double decided something

  /// Searches in the active lanes, row by row and in each row ball by ball. Each turn looks at one ball per
  /// lane.
  HWY_INLINE void run(Lanes& lanes) {
    lanes.active = this->set_anchor(lanes.active);
    stage2 = no_lane();
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
  // The limit of a single flight, so that no row is searched for more balls.
  static constexpr int kMaxTurns = kMaxCandidatesInRow;

  HWY_INLINE void start_rows(Lanes& lanes) {
    const V nu = this->row_beside_start(), reach = this->reach_of_rows();
    lanes.leave_unless(Abs(nu) + reach < all(kMaxCoefficient));
    slope_ = this->slope_of_rows();
    n_ = Ceil(nu - reach);
    last_ = nu + reach;
    m_ = none();
    found.s = infinite();
    found.s_error = found.slack = found.slack_error = found.across = none();
    found.n[0] = found.n[1] = none();
    found.v2 = to_.v2;
    if constexpr (!kBall)
      found.euclidean_v2 = to_.shape.euclidean_v2, found.v2_error = all(2 * to_.rho_error());
    in_order_ = this->are_in_order();
  }

  // The lanes of `next` begin row n_, at the m where the row enters the strip.
  HWY_INLINE void begin_rows(Lanes& lanes, M& scanning, M next) {
    const V last = select(to_.rises, last_ + Min(found.s, s_limit_) * slope_, last_);
    scanning = AndNot(And(next, Not(n_ <= last)), scanning);
    next = And(next, scanning);
    V unsure;
    const V m = this->start_of_row(n_, unsure);
    m_ = select(next, Ceil(m - unsure), m_);
    const M level = And(next, unsure > all(kMaxUnsure));
    if (HWY_LIKELY(nowhere(level))) return;
    const RowStart start = start_closely(rare(), this->lattice_, n_, level);
    m_ = select(start.known, start.m, m_), stage2 = Or(stage2, start.known);
    const M unknown = AndNot(start.known, level);
    lanes.leave(unknown);
    scanning = AndNot(unknown, scanning), next = AndNot(unknown, next);
  }

  // Copies, for decisions that binary64 cannot make.
  struct Rare {
    Direction to;
    Offset<LaneFma, 2> start;
    V anchor[2], s;
  };
  HWY_INLINE Rare rare() const {
    return {to_, this->offset_, {this->anchor_[0], this->anchor_[1]}, this->s_};
  }

  struct RowStart {
    V m;
    M known;
  };
  static HWY_NOINLINE RowStart start_closely(const Rare& rare, const Bravais& lattice, V n, M level) {
    LaneSearch2 search(rare.to, lattice, rare.start, nullptr, none());
    for (int i = 0; i < 2; ++i) search.anchor_[i] = rare.anchor[i];
    search.s_ = rare.s;
    RowStart start;
    start.known = search.start_of_level_row(n, level, start.m);
    return start;
  }

  static HWY_NOINLINE Close close_ball(const Rare& rare, const Bravais& lattice, V n0, V n1) {
    const V N[2] = {n0, n1};
    return LaneSearch2(rare.to, lattice, rare.start, nullptr, none()).look_closely(N);
  }

  // Looks at the ball n_ R + m_ L, as look_at does. A ball that is taken or beyond ends the row.
  HWY_INLINE void look(Lanes& lanes, M& scanning, M& next) {
    const V rho = to_.rho, zero = none();
    const auto ball = this->ball_at(n_, m_);
    const V h = ball.h;
    V s = ball.s, s_error = ball.s_error, slack = this->slack_of(ball),
      slack_error = this->slack_error_of(ball);
    const V spread = ball.error + all(to_.rho_error()) * rho;
    const M yes = Abs(h) + spread < rho;
    M no = Abs(h) - spread > rho, behind = s < Neg(s_error);
    const M late = s - s_error > Min(found.s + found.s_error, s_limit_);
    const M passed = Or(h < zero, Not(to_.rises));
    M candidate = AndNot(Or(no, Or(behind, late)), scanning);
    V N[2];
    const M exact = this->name_ball(n_, m_, N);
    M left = no_lane();
    if (leaving_ != nullptr) {
      left =
          And(And(candidate, exact), And(leaving_->any, And(N[0] == leaving_->n[0], N[1] == leaving_->n[1])));
      candidate = AndNot(left, candidate);
    }
    M met = And(And(candidate, exact), And(yes, s > s_error));
    const M unsure = AndNot(met, candidate), close = And(unsure, exact);
    M doubtful = unsure;
    if (HWY_UNLIKELY(any(close))) {
      const Close closer = close_ball(rare(), this->lattice_, N[0], N[1]);
      const M close_no = And(close, closer.is_missed), close_met = And(close, closer.is_met),
              close_behind = And(close_met, closer.is_behind), close_ahead = And(close_met, closer.is_ahead);
      s = select(close, closer.s, s), s_error = select(close, closer.s_error, s_error);
      slack = select(close, closer.slack, slack);
      slack_error = select(close, closer.slack_error, slack_error);
      no = Or(no, close_no), behind = Or(behind, close_behind), met = Or(met, close_ahead);
      doubtful = AndNot(Or(close_no, Or(close_behind, close_ahead)), doubtful);
      stage2 = Or(stage2, close);
    }
    const M take = And(met, s + s_error < found.s - found.s_error);
    doubtful = Or(doubtful, AndNot(take, met));
    lanes.leave(doubtful);
    scanning = AndNot(doubtful, scanning);
    found.n[0] = select(take, N[0], found.n[0]), found.n[1] = select(take, N[1], found.n[1]);
    found.s = select(take, s, found.s), found.s_error = select(take, s_error, found.s_error);
    found.slack = select(take, slack, found.slack);
    found.slack_error = select(take, slack_error, found.slack_error);
    if constexpr (!kBall) found.across = select(take, to_.sigma * h * to_.shape.skew, found.across);
    // Before the strip, behind the start, or the one that is left: the row goes on.
    const M before = And(scanning, Or(left, Or(AndNot(passed, no), AndNot(no, behind))));
    m_ = m_ + all(1);
    next = AndNot(before, scanning);
    const M over = And(And(next, found.s < infinite()), in_order_);
    scanning = AndNot(over, scanning), next = AndNot(over, next);
    n_ = select(next, n_ + all(1), n_);
  }

  const Leaving<2>* leaving_;
  V s_limit_;
  V slope_, n_, m_, last_;
  M in_order_;
};
