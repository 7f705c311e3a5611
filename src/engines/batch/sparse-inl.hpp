// The search for balls of lattices with fewer vectors than dimensions, in lanes, as in
// src/engines/reduction/sparse_search.hpp. Private to the batch engine.

template <int D>
struct LaneDirection {
  V v[D], v2, s_rho;

  HWY_INLINE void set(const Bravais& ball, const V (&velocity)[D]) {
    for (int k = 0; k < D; ++k) v[k] = velocity[k];
    v2 = speed_squared(v[0], v[1], D == 3 ? v[D - 1] : none());
    s_rho = width_of(all(ball.radius), v2);
  }
};

/// Looks at a ball in double-double. Rare code gets copies of its arguments.
template <int D>
HWY_NOINLINE CloseLook<LaneFma> look_at_close(LaneDirection<D> to, const Bravais& ball,
                                              Offset<LaneFma, D> at) {
  return CloseLook<LaneFma>(StableMeeting<LaneFma, D, true>(to.v, at.d, at.error, ball));
}

/// Like Search2 and Search3: in binary64, and in double-double where binary64 is not certain. kSingle: no
/// lattice has a vector.
template <int D, bool kSingle>
class SparseSearch {
 public:
  using Direction = LaneDirection<D>;

  LaneEntry<D, true> found;  ///< for the lanes that meet a ball: there found.s is finite
  M stage2;

  HWY_INLINE SparseSearch(const Direction& to, const Bravais& balls, const Offset<LaneFma, D>& start,
                          const Leaving<D>* leaving, V)
      : to_(to), balls_(balls), start_(start), leaving_(leaving) {}

  /// Searches in the active lanes.
  HWY_INLINE void run(Lanes& lanes) {
    stage2 = no_lane();
    found.v2 = to_.v2;
    for (V& n : found.n) n = none();
    found.s = infinite();
    found.s_error = found.slack = found.slack_error = none();
    if (kSingle || balls_.rank == 0) {
      look(found.n, start_.d, start_.error, lanes.active, lanes);
    } else {
      see();
      scan(lanes);
    }
  }

 private:
  using Vector = SparseVector<LaneFma, D>;
  using Row = SparseRow<LaneFma, D>;
  using Range = SparseRange<LaneFma>;

  HWY_INLINE void see() {
    for (int k = 0; k < D; ++k) start_seen_.a[k] = start_.d[k].hi;
    start_seen_.size = Sqrt(square_of(start_seen_.a));
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) rows_[i].t[j] = all(i == j && i < balls_.rank ? 1 : 0);
      for (int k = 0; k < D; ++k) rows_[i].seen.a[k] = all(i < balls_.rank ? balls_.basis[i][k].hi : 0);
      rows_[i].seen.size = Sqrt(square_of(rows_[i].seen.a)) + all(balls_.basis_error / kRoundoff);
    }
  }

  // Rows parallel to the line are left to single flights, and so are layers with more than a few rows near
  // the line.
  HWY_INLINE void scan(Lanes& lanes) {
    if constexpr (D == 3)
      if (balls_.rank == 2) shorten_across<LaneFma>(to_.v, rows_);
    turn_forward<LaneFma>(to_.v, rows_[0]);
    const Row along(to_.v, kSparse * kRoundoff, rows_[0].seen, balls_.radius, start_.error);
    lanes.leave(along.is_level());
    if (D == 2 || balls_.rank == 1) return scan_row(along, none(), lanes.active, lanes);
    if constexpr (D == 3) {
      const Range range = along.rows(start_seen_, rows_[1].seen);
      lanes.leave_unless(And(range.known, range.last - range.first < all(kMaxRowsInLane)));
      V k = range.first;
      for (M on = And(lanes.active, k <= range.last); any(on); on = And(lanes.active, k <= range.last)) {
        scan_row(along, k, on, lanes);
        k = k + all(1);
      }
    }
  }

  // Takes the first ball of row k that is met ahead, if it comes before the best so far.
  HWY_INLINE void scan_row(const Row& along, V k, M wanted, Lanes& lanes) {
    Vector start = start_seen_;
    start.add(k, rows_[1].seen);
    Range range = along.balls(start);
    lanes.leave(AndNot(range.known, wanted));
    const M is_long = range.last - range.first >= all(kMaxCandidatesInRow);
    if (any(And(is_long, wanted))) {
      const Range ahead = along.ahead(start);
      lanes.leave(And(wanted, AndNot(ahead.known, is_long)));
      range.first = select(is_long, Max(range.first, ahead.first), range.first);
    }
    V n = range.first;
    M going = And(And(wanted, lanes.active), n <= range.last);
    for (int step = 0; step < kMaxCandidatesInRow && any(going); ++step) {
      const M met = look_at(n, k, going, lanes);
      n = n + all(1);
      going = And(And(AndNot(met, going), lanes.active), n <= range.last);
    }
    lanes.leave(going);
  }

  // Looks at ball n of row k.
  HWY_INLINE M look_at(V n, V k, M wanted, Lanes& lanes) {
    V N[D];
    for (int i = 0; i < D; ++i) N[i] = none();
    for (int i = 0; i < balls_.rank; ++i) {
      const V along = n * rows_[0].t[i], beside = k * rows_[1].t[i];
      N[i] = along + beside;
      lanes.leave(AndNot(Max(Abs(along), Abs(beside)) < all(kMaxCoefficient / 2), wanted));
    }
    Pair d[D];
    const V error = place_of<false>(balls_, start_, N, d);
    return look(N, d, error, And(wanted, lanes.active), lanes);
  }

  // Looks at the ball of cell N, at d. Returns the lanes that meet it ahead. It is taken where it comes
  // before the best so far.
  HWY_INLINE M look(const V (&N)[D], const Pair (&d)[D], V error, M wanted, Lanes& lanes) {
    M asked = wanted;
    if (leaving_ != nullptr) {
      M left = leaving_->any;
      for (int i = 0; i < D; ++i) left = And(left, leaving_->n[i] == N[i]);
      asked = AndNot(left, asked);
    }
    const LoneBall<LaneFma, D> ball(to_.v, d, error, to_.v2, balls_.radius);
    const M no = Or(ball.is_missed(), ball.is_behind());
    M hit = And(AndNot(no, And(ball.is_met(), ball.is_ahead())), asked);
    LaneEntry<D, true> one;
    one.s = ball.s, one.s_error = ball.s_error, one.slack = ball.slack, one.slack_error = ball.slack_error;
    const M close = AndNot(Or(no, hit), asked);
    if (any(close)) look_closely(d, error, close, one, hit, lanes);
    M taken = hit;
    if constexpr (!kSingle) {
      const M later = found.s + found.s_error < one.s - one.s_error;
      const M sooner = one.s + one.s_error < found.s - found.s_error;
      lanes.leave(And(hit, Not(Or(later, sooner))));
      taken = And(hit, sooner);
      for (int i = 0; i < D; ++i) found.n[i] = select(taken, N[i], found.n[i]);
    }
    found.s = select(taken, one.s, found.s), found.s_error = select(taken, one.s_error, found.s_error);
    found.slack = select(taken, one.slack, found.slack);
    found.slack_error = select(taken, one.slack_error, found.slack_error);
    return hit;
  }

  HWY_INLINE void look_closely(const Pair (&d)[D], V error, M asked, LaneEntry<D, true>& one, M& hit,
                               Lanes& lanes) {
    Offset<LaneFma, D> there;
    for (int k = 0; k < D; ++k) there.d[k] = d[k], there.home[k] = none();
    there.error = error;
    const CloseLook<LaneFma> close = look_at_close(to_, balls_, there);
    stage2 = Or(stage2, asked);
    const M met = And(close.is_met, close.is_ahead),
            passed = Or(close.is_missed, And(close.is_met, close.is_behind));
    lanes.give_up(AndNot(Or(met, passed), asked));
    const M here = And(met, asked);
    hit = Or(hit, here);
    one.s = select(here, close.s, one.s), one.s_error = select(here, close.s_error, one.s_error);
    one.slack = select(here, close.slack, one.slack);
    one.slack_error = select(here, close.slack_error, one.slack_error);
  }

  static constexpr double kMaxRowsInLane = 12;

  const Direction& to_;
  const Bravais& balls_;
  const Offset<LaneFma, D>& start_;
  const Leaving<D>* leaving_;
  Vector start_seen_;
  SparseCombination<LaneFma, D> rows_[2];
};
